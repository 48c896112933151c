/*
 * rounded_box.h - a box of doubles as kernels that compute in float take it. About triangles of floats nothing is lost: no box
 * normal answers otherwise, and V_0 is rounded as for a box of floats (PROOFS.md 3.9).
 */
#ifndef TRIBOX_ROUNDED_BOX_H
#define TRIBOX_ROUNDED_BOX_H

#include <stdbool.h>

#include "tribox.h"

/* Infinite bounds stand for those that no float is beyond. */
typedef struct tribox_rounded_box {
    float lo[3], hi[3]; /* rounded inwards: no float lies between; or to nearest (tribox_box_round) */
    float H[3];         /* hi - lo */
    float C[3];         /* hi + lo - 2 l, where l is lo as rounded above: H and twice what that has moved */
    tribox_box exact;
} tribox_rounded_box;

/*
 * Of a finite box, in the environment of environment.h. Where the box normals are not asked, lo is the nearest float: then no
 * vertex is nearer to the bound than what rounding moves it.
 */
void tribox_box_round(const tribox_box *box, bool is_box_asked, tribox_rounded_box *rounded);

#endif
