/* plan.h - what a call runs, from its options. */
#ifndef TRIBOX_PLAN_H
#define TRIBOX_PLAN_H

#include "pairs/choice.h"

typedef struct tribox_plan {
    const tribox_kernel *kernel;
    tribox_accuracy accuracy;
    unsigned axes;        /* never 0 */
    tribox_choice choice; /* of the order of the groups: the state of the call, and all that changes in a plan */
} tribox_plan;

/* Whether what a caller has left for later versions is zero. */
static inline bool tribox_are_reserved_zero(const uint32_t reserved[4])
{
    return !(reserved[0] | reserved[1] | reserved[2] | reserved[3]);
}

/* TRIBOX_OK, TRIBOX_BAD_OPTION or TRIBOX_NO_KERNEL; options may be NULL. */
tribox_status tribox_plan_make(const tribox_options *options, tribox_plan *plan);

/* Writes what a call counted; report may be NULL. FAST leaves undecided only what is not finite or overflows: reported as 0. */
static inline void tribox_plan_report(const tribox_plan *plan, tribox_report counts, tribox_report *report)
{
    if (plan->accuracy == TRIBOX_FAST)
        counts.undecided = 0;
    if (report) {
        report->overlapping = counts.overlapping; /* one by one: counts were written just now, of which a copy costs 10 ns */
        report->undecided = counts.undecided;
    }
}

#endif
