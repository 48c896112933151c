/* settle.h - a batch of pairs that floats left open: the double stage of the kernel, then integers. */
#ifndef TRIBOX_SETTLE_H
#define TRIBOX_SETTLE_H

#include "plan.h"

/*
 * The bits of those of the first `count` pairs that overlap, at the accuracy of the plan. Only pairs with their bit in `finite`
 * have finite numbers, and an answer. Fills up the batch's numbers after the last.
 */
uint64_t tribox_settle_batch(tribox_batch *batch, unsigned count, uint64_t finite, const tribox_plan *plan);

#endif
