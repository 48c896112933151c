/* same_mesh.h - compares meshes bit for bit. */
#ifndef TRIBOX_TESTS_READ_SAME_MESH_H
#define TRIBOX_TESTS_READ_SAME_MESH_H

#include "read/mesh.h"

bool mesh_is_same(const mesh *a, const mesh *b);

/* Whether the bounds and the triangles that are not finite are what one finds who looks at one after another. */
bool mesh_is_looked_at_well(const mesh *m);

#endif
