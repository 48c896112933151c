/* accuracy_options.h - the command line of the program accuracy. */
#ifndef BENCH_ACCURACY_OPTIONS_H
#define BENCH_ACCURACY_OPTIONS_H

#include "common/measure.h"

enum { MESHES_MAX = 64 };

typedef struct settings {
    uint64_t seed;
    effort how;
    size_t stage_rounds;
    size_t triangles_most; /* of a scene */
    const char *scene;     /* NULL for all */
    bool has_scenes;
    unsigned along; /* cells along a side of the cube over a mesh */
    char cells[64]; /* the same in words */
    size_t cells_most;
    const char *csv, *json; /* NULL for none */
    const char *mesh[MESHES_MAX];
    size_t meshes;
} settings;

/** Reads the command line. Returns -1, or the status to exit with at once. */
int accuracy_options(int argc, char **argv, settings *s);

#endif
