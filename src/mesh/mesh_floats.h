/* mesh_floats.h - a mesh of floats against a box of doubles: as a soup is answered, from where the vertices lie. */
#ifndef TRIBOX_MESH_FLOATS_H
#define TRIBOX_MESH_FLOATS_H

#include "mesh_blocks.h"

typedef struct tribox_float_box {
    tribox_rounded_box box;
    tribox_box_pattern pattern;
} tribox_float_box;

/* A box of finite bounds. Every call is made in the environment of environment.h. */
void tribox_float_box_make(const tribox_box *box, const tribox_plan *plan, tribox_float_box *rounded);

static inline bool tribox_mesh_are_corners_walked(const tribox_plan *plan)
{
    return !TRIBOX_WALKS_SOUPS_ALONE && plan->axes == TRIBOX_AXES_ALL;
}

/* So many triangles take longer to be prepared than packets of them to be read: more are answered by blocks. */
enum { TRIBOX_MESH_FEW = 32 };

/*
 * A tribox_answer_block about all triangles of a mesh, TRIBOX_MESH_FEW at most, where corners are walked: each vertex is read where
 * it lies, four numbers wide, but for the last one, which is copied. Of the tribox_float_box only the box is needed.
 */
size_t tribox_mesh_answer_few(const tribox_mesh_query *query, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                              tribox_report *counts);

/* Whether walks take the corners of a mesh of floats: a tribox_answer_corners for tribox_mesh_query, or NULL. */
tribox_answer_corners *tribox_mesh_floats_corners(const tribox_plan *plan);

/* A tribox_answer_block about a tribox_float_box. */
size_t tribox_mesh_answer_floats(const tribox_mesh_query *query, const tribox_mesh *mesh, size_t first, size_t count,
                                 uint64_t *mask, tribox_report *counts);

#endif
