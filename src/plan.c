/* plan.c - from the options of a call to the kernel, the accuracy and the sequence of groups that it runs. */
#include "plan.h"

#include "dispatch.h"

enum { DEFAULT_ORDER = 132 };

/*
 * The sequence of a union of axes, or of an order of all of them; no order changes an answer. Group 1, 2, 3 is bit 0, 1, 2 of the
 * axes. A table, as a call about a few triangles would take longer to find it than to answer.
 */
static const unsigned char some[TRIBOX_AXES_ALL] = {
    TRIBOX_SEQUENCES,  TRIBOX_SEQUENCE_1,  TRIBOX_SEQUENCE_2,  TRIBOX_SEQUENCE_12,
    TRIBOX_SEQUENCE_3, TRIBOX_SEQUENCE_13, TRIBOX_SEQUENCE_32,
};
static const struct {
    unsigned order, sequence;
} all[] = {
    {132, TRIBOX_SEQUENCE_132}, {123, TRIBOX_SEQUENCE_123}, {213, TRIBOX_SEQUENCE_213},
    {231, TRIBOX_SEQUENCE_213}, {312, TRIBOX_SEQUENCE_312}, {321, TRIBOX_SEQUENCE_312},
};

/* TRIBOX_SEQUENCES if there is no such order, or no such axes. */
static unsigned sequence_of(unsigned order, unsigned axes)
{
    for (size_t k = 0; axes <= TRIBOX_AXES_ALL && k < sizeof all / sizeof all[0]; k++)
        if (order == all[k].order)
            return axes == TRIBOX_AXES_ALL ? all[k].sequence : some[axes];
    return TRIBOX_SEQUENCES;
}

tribox_status tribox_plan_make(const tribox_options *options, tribox_plan *plan)
{
    static const tribox_options defaults;
    const tribox_options *const asked = options ? options : &defaults;
    plan->accuracy = asked->accuracy;
    plan->axes = asked->axes ? asked->axes : TRIBOX_AXES_ALL;
    const bool is_fixed = asked->axis_order || plan->axes != TRIBOX_AXES_ALL;
    const unsigned order = asked->axis_order ? asked->axis_order : DEFAULT_ORDER;
    const unsigned sequence = is_fixed ? sequence_of(order, plan->axes) : TRIBOX_SEQUENCE_132;
    if ((unsigned)plan->accuracy > TRIBOX_FAST || sequence == TRIBOX_SEQUENCES || !tribox_are_reserved_zero(asked->reserved))
        return TRIBOX_BAD_OPTION;
    tribox_choice_start(&plan->choice);
    if (is_fixed)
        tribox_choice_fix(&plan->choice, sequence);
    plan->kernel = tribox_kernel_find(asked->kernel);
    return plan->kernel ? TRIBOX_OK : TRIBOX_NO_KERNEL;
}

const char *tribox_kernel_name(const tribox_options *options)
{
    const tribox_kernel *const kernel = tribox_kernel_find(options ? options->kernel : NULL);
    return kernel ? kernel->name : NULL;
}
