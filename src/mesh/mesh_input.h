/* mesh_input.h - what every call checks of a mesh before it reads it, and two ways of reading: as streams, for an oriented box. */
#ifndef TRIBOX_MESH_INPUT_H
#define TRIBOX_MESH_INPUT_H

#include <stdbool.h>

#include "kernel.h"
#include "pairs/oriented_words.h"

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

/*
 * Triangles first .. first + count - 1 of a mesh whose strides are set, none of whose vertices is missing, to the streams x_0 x_1
 * x_2 y_0 y_1 y_2 z_0 z_1 z_2: u - origin, taken in double, as the nearest float; or u, where origin is NULL. Those that a list
 * names, if it is not NULL: then there is room for whole packets. In the environment of environment.h.
 */
void tribox_mesh_write_soup(const tribox_mesh *mesh, const tribox_kernel *kernel, const double *origin, const uint32_t *list,
                            size_t first, size_t count, float *const to[9]);

/* The origin that a caller gives, 0 of NULL. False if it is not finite. */
bool tribox_mesh_origin_of(const double *origin, double of[3]);

/*
 * A question (pairs/oriented_words.h) about a mesh whose strides are set and which has all vertices that its triangles name, and a
 * finite box that is not empty. Both are kept by address. In the environment of environment.h.
 */
void tribox_oriented_ask_mesh(tribox_oriented_query *q, const tribox_mesh *mesh, const tribox_oriented_box *box, tribox_plan *plan);

#endif
