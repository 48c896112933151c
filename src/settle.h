/* settle.h - a batch of pairs that the walks left open: the double stage of the kernel, then integers. */
#ifndef TRIBOX_SETTLE_H
#define TRIBOX_SETTLE_H

#include "plan.h"

/*
 * What the first `count` pairs of a batch, at least one, come to at the accuracy and by the axes of the plan: none stays open. The
 * numbers of the triangles are finite or not, and those that are not overlap nothing; the batch is as kernel.h has it. Numbers after
 * the last pair are written over.
 */

/* All numbers are floats. */
tribox_verdict tribox_settle_batch(tribox_batch *batch, unsigned count, const tribox_plan *plan);

/*
 * Any doubles. Pairs with numbers so large or so small that the double stage cannot bound its errors are found here, and settled in
 * integers at every accuracy.
 */
tribox_verdict tribox_settle_batch_f64(tribox_batch *batch, unsigned count, const tribox_plan *plan);

#endif
