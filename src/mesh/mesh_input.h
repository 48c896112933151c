/* mesh_input.h - what every call checks of a mesh before it reads it. */
#ifndef TRIBOX_MESH_INPUT_H
#define TRIBOX_MESH_INPUT_H

#include <stdbool.h>

#include "kernel.h"

/* Whether the mesh can be read, but for vertex numbers that are too great. If so, the same mesh, its strides set. */
bool tribox_mesh_take(const tribox_mesh *mesh, tribox_mesh *strided);

/* Of a mesh with strides: whether the three numbers of a vertex follow each other, in any order of the axes. */
bool tribox_mesh_has_triples(const tribox_mesh *mesh);

/* Whether they are x, y, z, so that kernels read them where they lie: as floats, or as doubles. */
bool tribox_mesh_has_floats(const tribox_mesh *mesh);
bool tribox_mesh_has_doubles(const tribox_mesh *mesh);

/* The positions of corners first .. first + count - 1 of a mesh with strides, whatever they are. */
void tribox_mesh_read_corners(const tribox_mesh *mesh, size_t first, size_t count, double (*to)[3]);

/* Whether triangles first .. first + count - 1 name vertices of the mesh only. */
bool tribox_mesh_is_in_range(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t count);

#endif
