/* ordered_mesh.h - a mesh whose triangles are put into an order in which those that are near in number are near in space. */
#ifndef ORDERED_MESH_H
#define ORDERED_MESH_H

#include "read/mesh.h"

/*
 * Orders the triangles of a mesh. Returns the number that each had before, for free(); NULL, with the mesh as it was, where not as
 * much memory is available: another mesh and 4 bytes a triangle while it works, these 4 bytes afterwards.
 */
uint32_t *mesh_order(mesh *m, unsigned threads);

#endif
