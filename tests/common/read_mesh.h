/* read_mesh.h - reads the two mesh formats of the mesh tests: binary little-endian PLY of float triangles, and binary STL. */
#ifndef TRIBOX_TESTS_MESH_H
#define TRIBOX_TESTS_MESH_H

#include <stdbool.h>
#include <stddef.h>

typedef struct mesh {
    size_t count;
    float *coordinate[3][3]; /* vertex, axis: a stream of `count` numbers */
} mesh;

/* False, with a message that says what is wrong, if the file cannot be read or is of another kind. */
bool mesh_read(const char *path, mesh *m);

void mesh_free(mesh *m);

#endif
