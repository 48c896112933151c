/* overlap_boxes.c - which of many boxes a triangle overlaps: the call. */
#include "base/box.h"
#include "base/environment.h"
#include "base/finite.h"
#include "pairs/pairs.h"

#if !defined(TRIBOX_SMALL)
tribox_status tribox_overlap_boxes(const float triangle[9], const tribox_boxes *boxes, const tribox_options *options,
                                   uint64_t *mask, tribox_report *report)
{
    if (!triangle || !tribox_boxes_are_readable(boxes))
        return TRIBOX_BAD_ARGUMENT;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    const tribox_query pairs = {.triangle = triangle, .boxes = boxes, .count = boxes->count};
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    if (tribox_are_finite(triangle, 9)) /* for others the walks would find nothing either */
        counts = tribox_pairs_answer(&pairs, &plan, mask);
    else
        tribox_pairs_write_none(boxes->count, mask);
    tribox_environment_leave(callers);
    tribox_plan_report(&plan, counts, report);
    return TRIBOX_OK;
}
#endif
