/*
 * rounded_box.h - a box of doubles as kernels that compute in float take it. About triangles of floats nothing is lost: no box
 * normal answers otherwise, and V_0 is rounded as for a box of floats (PROOFS.md 3.9).
 */
#ifndef TRIBOX_ROUNDED_BOX_H
#define TRIBOX_ROUNDED_BOX_H

#include <stdbool.h>

#include "compiler.h"
#include "tribox.h"

/* What V_0 is taken from, H and C: hi - lo and hi + lo - 2 origin, of the bounds themselves. */
typedef struct tribox_box_floats {
    float origin[3], H[3], C[3];
} tribox_box_floats;

/* Infinite bounds stand for those that no float is beyond. */
typedef struct tribox_rounded_box {
    float lo[3], hi[3]; /* rounded inwards: no float lies between */
    tribox_box_floats of, fast;
    tribox_box exact;
} tribox_rounded_box;

/*
 * Of a finite box, in the environment of environment.h. The origin is lo; where the box normals are not asked, it is the float
 * nearest to lo: then no vertex is nearer to the bound than the origin is. Returns whether all bounds are floats.
 *
 * is_fast: what FAST takes, too. It trusts signs, and rounding alone has the sign of a tie. So its origin is the middle, from where
 * less is lost of vertices near the box, if the bounds are floats from there as well; and its H is longer by what the product of a
 * length and one edge can lose (PROOFS.md 10).
 */
bool tribox_box_round(const tribox_box *box, bool is_box_asked, bool is_fast, tribox_rounded_box *rounded);

/* The least float that is not below a number: infinite if there is none. */
float tribox_float_from(double number);

#endif
