/* mesh_streams.h - triangles of a mesh of doubles or floats as nine streams of floats, relative to an origin. */
#ifndef TRIBOX_MESH_STREAMS_H
#define TRIBOX_MESH_STREAMS_H

#include "kernel.h"

/*
 * Triangles first .. first + count - 1 of a mesh whose strides are set, none of whose vertices is missing, to the streams x_0 x_1
 * x_2 y_0 y_1 y_2 z_0 z_1 z_2: u - origin, taken in double, as the nearest float; or u, where origin is NULL. Those that a list
 * names, if it is not NULL: then there is room for whole packets. In the environment of environment.h.
 */
void tribox_mesh_write_soup(const tribox_mesh *mesh, const tribox_kernel *kernel, const double *origin, const uint32_t *list,
                            size_t first, size_t count, float *const to[9]);

/* The origin that a caller gives, 0 of NULL. False if it is not finite. */
bool tribox_mesh_origin_of(const double *origin, double of[3]);

#endif
