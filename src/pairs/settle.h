/* settle.h - a batch of pairs that the walks left undecided: the double stage of the kernel, then integers. */
#ifndef TRIBOX_SETTLE_H
#define TRIBOX_SETTLE_H

#include "plan.h"

/*
 * What the first `count` pairs of a batch, at least one, come to at the accuracy and by the axes of the plan: none stays undecided.
 * The numbers are any doubles, those of the triangles finite or not; what is not finite overlaps nothing. Those after the last pair
 * are written over. packed: if not NULL, the triangles: then the batch has boxes alone.
 */
tribox_verdict tribox_settle_packed(tribox_batch *batch, tribox_packed *packed, unsigned count, const tribox_plan *plan);

static inline tribox_verdict tribox_settle_batch(tribox_batch *batch, unsigned count, const tribox_plan *plan)
{
    return tribox_settle_packed(batch, NULL, count, plan);
}

#endif
