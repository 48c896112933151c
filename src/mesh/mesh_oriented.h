/* mesh_oriented.h - words of triangles of a mesh and an oriented box. */
#ifndef TRIBOX_MESH_ORIENTED_H
#define TRIBOX_MESH_ORIENTED_H

#include "pairs/oriented_words.h"

/*
 * A question (pairs/oriented_words.h) about a mesh whose strides are set and which has all vertices that its triangles name, and a
 * finite box that is not empty. Both are kept by address. In the environment of environment.h.
 */
void tribox_oriented_ask_mesh(tribox_oriented_query *q, const tribox_mesh *mesh, const tribox_oriented_box *box, tribox_plan *plan);

#endif
