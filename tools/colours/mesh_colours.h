/* mesh_colours.h - the colour of each triangle of a mesh file, in the order of mesh.h. */
#ifndef MESH_COLOURS_H
#define MESH_COLOURS_H

#include <stddef.h>

#include "read/triangle_file.h"
#include "rgb.h"
#include "write/file_out.h"

typedef struct mesh_colours {
    rgb *of;          /* each triangle */
    size_t triangles; /* of the mesh */
    const char *from; /* whose they are, in a word: "faces" */
} mesh_colours;

/*
 * Reads a mesh file again, for its colours alone. A polygon has one colour, and so have the triangles that it is cut into.
 *
 * PLY, OFF: that of the face; where faces have none, the mean of the colours of its corners.
 * OBJ: the mean of its corners, where all of them have one, `v X Y Z R G B`; else Kd of its material; else grey.
 * What libassimp reads: the same of glTF and its like, the colour of the corners times that of the material.
 * Whole numbers go to 255, those of 16 bits to 65535, others to 1.
 *
 * triangles: of the mesh, as it was read before. outputs: none of these may be a file of materials. Returns an exit_code; a mesh
 * without colours is a failure. On success mesh_colours_free gives the memory back.
 */
int mesh_colours_read(const char *path, triangle_format format, size_t triangles, const file_out_names *outputs,
                      mesh_colours *colours);
void mesh_colours_free(mesh_colours *colours);

#endif
