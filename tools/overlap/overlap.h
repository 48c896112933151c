/* overlap.h - a request of tribox overlap, its answer, what prints it, and what asks an index for it. */
#ifndef OVERLAP_H
#define OVERLAP_H

#include <stdbool.h>

#include "console/json.h"
#include "crop/crop.h"
#include "read/boxes.h"
#include "read/mesh.h"
#include "tribox.h"

typedef struct request {
    const char *mesh_path;
    triangle_format format; /* OTHER: by the name of the mesh */
    mesh_shift shift;       /* with --shift */
    written_box box;        /* with --box */
    bool has_box;
    const char *boxes_path;       /* with --boxes, else NULL */
    tribox_oriented_box oriented; /* with --oriented */
    bool has_oriented;
    tribox_options test;
    bool wants_inside, wants_list, wants_json, is_quiet;
    uint32_t threads;
    const char *crop_paths[CROP_SIDES]; /* with -o and --rest, else NULL */
    bool has_report;                    /* standard output is free for it, and it is wanted */
} request;

/* A bit per triangle: which overlap and, with --inside, which of these lie inside; else `inside` is NULL. */
typedef struct masks {
    uint64_t *overlap, *inside;
} masks;

/* Triangles to ask about: all of a mesh, or a block. */
typedef struct asked_triangles {
    size_t count;
    bool is_double;
    tribox_soup soup;    /* as floats */
    tribox_mesh doubles; /* as doubles if is_double */
} asked_triangles;

/* Of an index over the mesh: none, one over its triangles as they come in the file, one over triangles in order. */
typedef enum index_stage { INDEX_NONE, INDEX_IN_FILE_ORDER, INDEX_ORDERED } index_stage;

/* One box and what was found. */
typedef struct answer {
    tribox_box box; /* not with --oriented */
    bool is_double; /* the mesh has coordinates that float does not hold */
    size_t line;    /* of the boxes file; 0 without one */
    uint64_t triangles, left_out, not_finite;
    uint64_t rounded; /* vertices that rounding to float has moved */
    double moved;     /* the most that it has moved a coordinate */
    uint64_t overlapping, undecided, inside;
    int runs;
    double seconds;               /* of the test alone, best run */
    double total_seconds;         /* with reading, where the mesh is streamed; else 0 */
    index_stage stage;            /* whether it was found by an index */
    crop_counts crop[CROP_SIDES]; /* what was written */
    json json;                    /* the object that is being printed */
} answer;

/* Allocates the bits of `count` triangles. Returns an exit_code; on success masks_free frees them. */
int masks_make(size_t count, bool wants_inside, masks *bits);

void masks_free(masks *bits);

/* Tests triangles once and adds counts and time to the answer. Returns an exit_code. */
int overlap_ask(const request *r, const asked_triangles *t, const masks *bits, answer *a);

asked_triangles triangles_of_mesh(const mesh *m);

/* From the mesh to the report. Returns an exit_code. */
int overlap_work(const request *r);

/*
 * Tests one box while the mesh is read, in constant memory, but for a bit a triangle where it is written again. Closes the file.
 * files: NULL where it is not. Returns an exit_code.
 */
int overlap_stream(const request *r, triangle_file *file, crop_files *files);

/* Writes the mesh again by what was found. Returns an exit_code. */
int overlap_crop(const request *r, const masks *bits, crop_files *files, answer *a);

/* What an index finds: the words of a mask that are not zero, in ascending order. */
typedef struct found_words {
    size_t room;       /* the words of the whole mask */
    size_t count;      /* those that are there */
    uint32_t *number;  /* bit b of bits[k] is triangle 64 * number[k] + b */
    uint64_t *bits;    /* what all others point into */
    uint64_t *mask;    /* a whole mask and */
    uint64_t *touched; /* a bit for each of its words: zero between calls */
} found_words;

/*
 * Continues the list of an answer, or starts it where first is 0, with the numbers of the triangles first .. first + count - 1
 * whose bits are set. Returns an exit_code.
 */
int report_list(const request *r, answer *a, uint64_t first, const uint64_t *mask, size_t count);

/* The whole list of an answer, from the words that are not zero. Returns an exit_code. */
int report_words(const request *r, answer *a, const found_words *words);

/* Prints the rest of the answer, or all of it where no list is wanted, and flushes the output. Returns an exit_code. */
int report_end(const request *r, answer *a);

typedef struct box_after_box {
    const request *r;
    mesh *m;
    index_stage stage, last; /* the last that can be reached */
    double seconds;          /* of the tests at this stage */
    masks bits;              /* of tests without an index */
    tribox_index index;
    void *nodes;       /* of the index */
    uint32_t *order;   /* the number in the file of each triangle; NULL until the mesh is in order */
    found_words words; /* with --list */
} box_after_box;

/* Returns an exit_code; on success box_after_box_end gives back what this and the questions have taken, but not the mesh. */
int box_after_box_start(const request *r, mesh *m, box_after_box *b);

/* Answers a->box. Returns an exit_code. */
int box_after_box_ask(box_after_box *b, answer *a);

/* Prints the list of the last answer. Returns an exit_code. */
int box_after_box_list(const box_after_box *b, answer *a);

void box_after_box_end(box_after_box *b);

#endif
