/* mesh_triangles.h - a file of triangles, binary STL or raw, as a mesh. */
#ifndef MESH_TRIANGLES_H
#define MESH_TRIANGLES_H

#include "mesh.h"

/*
 * Reads all of an open file into an empty mesh, a regular one by threads. Returns an exit_code; mesh_free may follow in any case.
 */
int mesh_read_triangles(triangle_file *file, unsigned threads, mesh *m);

#endif
