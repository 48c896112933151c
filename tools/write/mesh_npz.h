/* mesh_npz.h - a mesh as arrays for numpy.load. */
#ifndef MESH_NPZ_H
#define MESH_NPZ_H

#include "colours/rgb.h"
#include "file_out.h"
#include "read/mesh.h"

/*
 * Writes vertices, of floats or doubles as the mesh is, faces, and colours of these, NULL for none. Vertices at one place are one,
 * in the order in which faces come to them. Returns an exit_code; file_out_keep is the caller's next step.
 */
int mesh_npz_write(const file_out *out, const mesh *m, const rgb *colours);

#endif
