/* mesh_input.h - what every call checks of a mesh before it reads it. */
#ifndef TRIBOX_MESH_INPUT_H
#define TRIBOX_MESH_INPUT_H

#include <stdbool.h>

#include "kernel.h"

/*
 * Whether the mesh can be read, but for vertex numbers that are too great: by the calls that take floats alone, and by the
 * others.
 */
bool tribox_mesh_is_readable(const tribox_mesh *mesh);
bool tribox_mesh_is_readable_f64(const tribox_mesh *mesh);

/* The same mesh, its strides set. */
tribox_mesh tribox_mesh_with_strides(const tribox_mesh *mesh);

/* Of a mesh with strides, whether positions are doubles that follow each other: kernels read them where they lie. */
bool tribox_mesh_is_direct(const tribox_mesh *mesh);

/* The positions of corners first .. first + count - 1 of a mesh with strides, whatever they are. */
void tribox_mesh_read_corners(const tribox_mesh *mesh, size_t first, size_t count, double (*to)[3]);

/* Whether triangles first .. first + count - 1 name vertices of the mesh only. */
bool tribox_mesh_is_in_range(const tribox_mesh *mesh, const tribox_kernel *kernel, size_t first, size_t count);

#endif
