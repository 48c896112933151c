/* plan.c - from the options of a call to the kernel, the accuracy and the sequence of groups that it runs. */
#include "plan.h"

#include "dispatch.h"

enum { DEFAULT_ORDER = 132 };

static bool is_order(unsigned order)
{
    return order == 123 || order == 132 || order == 213 || order == 231 || order == 312 || order == 321;
}

/* The order without the groups that axes leaves out; no order changes an answer. Group 1, 2, 3 is bit 0, 1, 2 of the axes. */
static unsigned sequence_of(unsigned order, unsigned axes)
{
    unsigned sequence = 0;
    for (unsigned place = 100; place; place /= 10) {
        const unsigned group = order / place % 10;
        if (axes >> (group - 1) & 1)
            sequence = 10 * sequence + group;
    }
    return sequence;
}

static unsigned sequence_index(unsigned sequence)
{
    switch (sequence) {
#define INDEX(sequence) \
    case sequence: \
        return TRIBOX_SEQUENCE_##sequence;
        TRIBOX_FOR_EACH_SEQUENCE(INDEX)
    }
    return TRIBOX_SEQUENCES;
}

tribox_status tribox_plan_make(const tribox_options *options, tribox_plan *plan)
{
    static const tribox_options defaults;
    const tribox_options *const asked = options ? options : &defaults;
    const unsigned order = asked->order ? asked->order : DEFAULT_ORDER;
    plan->accuracy = asked->accuracy;
    plan->axes = asked->axes ? asked->axes : TRIBOX_AXES_ALL;
    if ((unsigned)plan->accuracy > TRIBOX_FAST || plan->axes & ~(unsigned)TRIBOX_AXES_ALL || !is_order(order))
        return TRIBOX_BAD_OPTION;
    plan->choice = asked->order || plan->axes != TRIBOX_AXES_ALL
                       ? tribox_choice_fixed(sequence_index(sequence_of(order, plan->axes)))
                       : tribox_choice_start();
    plan->kernel = tribox_kernel_find(asked->kernel);
    return plan->kernel ? TRIBOX_OK : TRIBOX_NO_KERNEL;
}

void tribox_plan_report(const tribox_plan *plan, tribox_report counts, tribox_report *report)
{
    if (plan->accuracy == TRIBOX_FAST)
        counts.undecided = 0;
    if (report)
        *report = counts;
}

const char *tribox_kernel_name(const tribox_options *options)
{
    const tribox_kernel *const kernel = tribox_kernel_find(options ? options->kernel : NULL);
    return kernel ? kernel->name : NULL;
}
