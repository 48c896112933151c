/* overlap.h - a request of tribox overlap, and its answer. */
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
    bool wants_inside, wants_list, wants_json;
    uint32_t threads;
    const char *crop_paths[CROP_SIDES]; /* with -o and --rest, else NULL */
    bool has_report;                    /* standard output is free for it */
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

#endif
