/* real_meshes.h - a case that tries real meshes in turn. They are not part of the project: without them it is skipped. */
#ifndef TRIBOX_TESTS_REAL_MESHES_H
#define TRIBOX_TESTS_REAL_MESHES_H

#include <stddef.h>

#include "arguments.h"
#include "tribox.h"

typedef struct mesh {
    size_t count;
    float *coordinate[3][3]; /* vertex, axis: a stream of `count` numbers */
} mesh;

tribox_box mesh_bounds(const mesh *m);

void mesh_triangle(const mesh *m, size_t i, float u[3][3]);

typedef void mesh_trial(const arguments *args, const char *name, const mesh *m);

/* Calls `try_mesh` on every file of the folder that the arguments name; skips the case where they name none. */
void real_meshes_try(const arguments *args, mesh_trial *try_mesh);

/* The main of a program of this case alone: exit code 77 where no folder is named. */
int real_meshes_main(int argc, char **argv, mesh_trial *try_mesh);

#endif
