/*
 * mesh_local.h - a mesh of doubles against a box: vertices rounded relative to the box for the walks, and what they leave undecided
 * settled.
 */
#ifndef TRIBOX_MESH_LOCAL_H
#define TRIBOX_MESH_LOCAL_H

#include "mesh_blocks.h"

/* A box of doubles, and the same for the walks. */
typedef struct tribox_local_box {
    const tribox_box *box;
    tribox_rounded_box moved;    /* from 0 to its lengths, rounded to float */
    double origin[TRIBOX_LOCAL]; /* its lower corner */
    tribox_box_pattern pattern;
    tribox_local_walk walk;
    bool are_hits_certain; /* else the walk tests the box normals alone, and all that they leave is undecided */
} tribox_local_box;

/* Whether the float stage can tell: no product of lengths overflows or vanishes (PROOFS.md 14.4). */
bool tribox_is_ordinary(const tribox_box *box);

/* A box of finite bounds. Every call is made in the environment of environment.h, and the accuracy of the plan is not FAST. */
void tribox_local_box_make(const tribox_box *box, const tribox_plan *plan, tribox_local_box *local);

/* A tribox_answer_corners for a mesh, or NULL where its positions do not follow each other. */
tribox_answer_corners *tribox_mesh_local_corners(const tribox_mesh *mesh);

/* A tribox_answer_block about a tribox_local_box. The strides of the mesh are set. */
size_t tribox_mesh_answer_local(const tribox_mesh_query *query, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                tribox_report *counts);

/* The candidates among the triangles of a word, from triangle `first` on, whose vertices are all in the box. */
uint64_t tribox_mesh_inside(const tribox_mesh *mesh, const tribox_box *box, size_t first, uint64_t candidates);

#endif
