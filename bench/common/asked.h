/* asked.h - the options and meshes that a question is asked with, and what all questions do with them. */
#ifndef BENCH_ASKED_H
#define BENCH_ASKED_H

#include "console/message.h"
#include "printout.h"
#include "timing/timing.h"

/* Meshes of the command line: files, or names in the folder $TRIBOX_MESHES. */
typedef struct mesh_list {
    const char *const *path;
    size_t count;
} mesh_list;

struct mesh;
struct indexed_mesh;

/* False after a line on standard error. */
bool mesh_list_read(const char *path, struct mesh *m);

/* The same with its vertices and indices, of floats: PLY, OFF and OBJ. indexed_mesh_free follows in any case. */
bool mesh_list_read_indexed(const char *path, struct indexed_mesh *m);

/*
 * One table of options, for all questions: the name, what stands for its value, what --help says, and the least and the most of a
 * number; a text has none.
 */
#define ASKED_OPTIONS(OPTION) \
    OPTION(OPTION_ROUNDS, "rounds", "N", "measure N rounds, however long they take", 1, MEASURE_MOST) \
    OPTION(OPTION_SEED, "seed", "N", "of what is drawn, and of the order within the rounds", 0, UINT64_MAX) \
    OPTION(OPTION_JSON, "json", NULL, "JSON instead of text", 0, 0) \
    OPTION(OPTION_CSV, "csv", "FILE", "also writes the tables to a file", 0, 0) \
    OPTION(OPTION_KERNEL, "kernel", "NAME", "without it the widest", 0, 0) \
    OPTION(OPTION_QUICK, "quick", NULL, "little work and few rounds: seconds", 0, 0) \
    OPTION(OPTION_SCENE, "scene", "NAME", "one scene; an unknown one lists them", 0, 0) \
    OPTION(OPTION_NO_SCENES, "no-scenes", NULL, "meshes alone", 0, 0) \
    OPTION(OPTION_FILTER, "filter", "PART", "only contestants whose name contains it", 0, 0) \
    OPTION(OPTION_SIZE, "size", "N", "triangles of a scene", 64, 100000000) \
    OPTION(OPTION_FAST, "fast", NULL, "FAST; without it EXACT", 0, 0) \
    OPTION(OPTION_VERIFY, "verify", NULL, "compares answers, and times nothing", 0, 0) \
    OPTION(OPTION_CELLS, "cells", "N,...", "cells along the longest side", 2, 1 << 20) \
    OPTION(OPTION_TILE, "tile", "N", "cells of a tile along an axis, a multiple of 8", 8, 1024) \
    OPTION(OPTION_LIMIT, "limit", "SECONDS", "a rival that takes longer is ended", 1, 3600) \
    OPTION(OPTION_OCTREE, "octree", "DEPTH", "the leaves of an octree over a mesh", 1, 10) \
    OPTION(OPTION_GRID, "grid", "N", "cells of a grid over a mesh, N along its longest side", 1, 4096) \
    OPTION(OPTION_BOXES, "boxes", "N", "boxes", 1, 100000) \
    OPTION(OPTION_TERRAIN, "terrain", "N", "triangles of a terrain that is made here", 0, UINT32_MAX)

#define ASKED_OPTION(option, ...) option,
typedef enum asked_option { ASKED_OPTIONS(ASKED_OPTION) OPTIONS } asked_option;

enum { ASKED_CELLS = 16 };

typedef struct asked {
    const struct bench_question *of; /* what is asked */
    uint64_t number[OPTIONS];        /* 1 of a flag that was given, and of a text */
    const char *text[OPTIONS];
    uint64_t given; /* bit o: option o */
    uint64_t seed;
    const char *kernel; /* one that runs here */
    uint32_t cells[ASKED_CELLS];
    size_t cell_counts;
    mesh_list meshes;
    size_t scenes;   /* asked about so far, with the one in question */
    generator order; /* of the turns */
    printout out;
    samples taken; /* by asked_measure */
    score scores[CONTESTANTS_MAX];
} asked;

typedef struct bench_question {
    const char *name;
    const char *asks;         /* a line for --help */
    unsigned options;         /* bits of asked_option; those of all questions are not named */
    bool takes_meshes;        /* files on the command line */
    bool needs_meshes;        /* asks nothing without one */
    bool (*answer)(asked *q); /* false after a line on standard error */
} bench_question;

/* A main program: the question's name comes first, if there are several. Returns an exit_code. */
int asked_main(int argc, char **argv, const bench_question *const *questions, size_t count, asked *q);

static inline bool asked_has(const asked *q, asked_option option) { return q->given >> option & 1; }

/* What was given, or else... */
uint64_t asked_number(const asked *q, asked_option option, uint64_t otherwise);

/* Reads numbers of cells. Returns an exit_code. */
int asked_cells(asked *q, const char *value);

/* As many rounds as were given, or else at most so many within so many seconds; few if it shall be quick. */
effort asked_effort(const asked *q, size_t rounds, double seconds, double sample);

/*
 * Verifies the list and times it, into `taken` and `scores`. from: NULL where there is nothing to compare. name: for the message
 * if somebody is wrong, and nothing is timed. words: room for an answer.
 */
bool asked_measure(asked *q, const char *name, const contestant *list, size_t count, const truth *from, effort how, size_t words);
bool asked_verify(asked *q, const char *name, const contestant *list, size_t count, const truth *from);

/* Zeros that were touched, from a cache line on. Ends the program if there is no memory. It lasts until asked_release. */
void *asked_allocate(size_t count, size_t size);

/* Frees what was allocated after this was asked_mark's. */
void *asked_mark(void);
void asked_release(void *mark);

#endif
