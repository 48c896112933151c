/*
 * rounded_frame.h - an oriented box of doubles as kernels that compute in float take it: what is rounded once a box, and how far.
 *
 * Points are moved from `center`, which is the nearest float to that of the box; what it leaves of the center is a place in the
 * frame, `middle`, about which the box lies. Where all numbers of the box are floats, so are all of these, and nothing is rounded.
 * An axis of the box that is one of space, which the two others do not see, moves nothing: `center` is 0 there, and a place is the
 * coordinate itself, or its opposite, to the last bit.
 */
#ifndef TRIBOX_ROUNDED_FRAME_H
#define TRIBOX_ROUNDED_FRAME_H

#include <stdbool.h>

#include "tribox.h"

typedef struct tribox_rounded_frame {
    float center[3];
    float axis[3][3]; /* the nearest floats */
    float size[3][3]; /* of each at least its size, and 2^24 times what rounding has moved it; 0 on an axis that moves nothing */
    float lost[3];    /* what underflow costs a place on an axis; infinite where float is too narrow for the box */
    /* The box on each axis: bounds that it does not reach beyond, and bounds that it reaches (PROOFS.md 8.2). */
    float outer_lo[3], outer_hi[3], inner_lo[3], inner_hi[3];
    double middle[3]; /* and the half lengths to both sides of it */
    double slack[3];  /* how far off the middle and the bounds about it may be, together */
    float near[3];    /* what reaches no farther from the center on each axis of space is asked with one error for all */
} tribox_rounded_frame;

/*
 * Of a finite box that is not empty, in the environment of environment.h, for points p that are given as
 *   p - origin, exactly, where origin may be NULL for 0
 *   or, if are_rounded, the float nearest to p - origin in double, which is finite.
 */
void tribox_frame_round(const tribox_oriented_box *box, const double *origin, bool are_rounded, tribox_rounded_frame *frame);

/* Whether the axes of a finite box are those of space, and its bounds there doubles: it is that box then. In any environment. */
bool tribox_oriented_is_upright(const tribox_oriented_box *box, tribox_box *upright);

/* How far off on axis k a point can be that is moved into the frame, `reach` at most from the center on each axis of space. */
float tribox_frame_error(const tribox_rounded_frame *frame, int k, float reach);

#endif
