/* settle.h - a batch of pairs that floats left open: the double stage of the kernel, then integers. */
#ifndef TRIBOX_SETTLE_H
#define TRIBOX_SETTLE_H

#include "plan.h"

/*
 * What the first `count` pairs come to at the accuracy of the plan: none stays open. Fills up the batch's numbers after the last.
 */
tribox_verdict tribox_settle_batch(tribox_batch *batch, unsigned count, const tribox_plan *plan);

#endif
