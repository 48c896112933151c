/*
 * rounded_box.h - a box of doubles as kernels that compute in float take it. About triangles of floats nothing is lost: no box
 * normal answers otherwise, and V_0 is rounded as for a box of floats (PROOFS.md 3.9).
 */
#ifndef TRIBOX_ROUNDED_BOX_H
#define TRIBOX_ROUNDED_BOX_H

#include <stdbool.h>

#include "compiler.h"
#include "tribox.h"

/* Infinite bounds stand for those that no float is beyond. */
typedef struct tribox_rounded_box {
    float lo[3], hi[3]; /* rounded inwards: no float lies between */
    float origin[3];    /* that V_0 is taken from: lo, or the float next to the bound (tribox_box_round) */
    float H[3];         /* hi - lo, of the bounds themselves */
    float C[3];         /* hi + lo - 2 origin: H, less twice what rounding has moved lo by */
    tribox_box exact;
} tribox_rounded_box;

/*
 * Of a finite box, in the environment of environment.h. Where the box normals are not asked, the origin is the float nearest to lo:
 * then no vertex is nearer to the bound than the origin is.
 */
void tribox_box_round(const tribox_box *box, bool is_box_asked, tribox_rounded_box *rounded);

/* The least float that is not below a number: infinite if there is none. */
float tribox_float_from(double number);

#endif
