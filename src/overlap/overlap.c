/* overlap.c - which triangles overlap a box: the calls. */
#include "base/environment.h"
#include "overlap_call.h"

static tribox_status overlap_with(tribox_overlap_call *c, tribox_codes *codes, uint64_t *mask, tribox_report *report)
{
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    tribox_call_start(c, codes, true);
    const bool is_answered = tribox_call_answer(c, mask, &counts);
    tribox_environment_leave(callers);
    if (!is_answered)
        return TRIBOX_BAD_VERTEX;
    tribox_call_report(c, counts, report);
    return TRIBOX_OK;
}

TRIBOX_NOINLINE tribox_status overlap_coded(tribox_overlap_call *c, uint64_t *mask, tribox_report *report)
{
    tribox_codes codes;
    return overlap_with(c, &codes, mask, report);
}

/* One that was checked. */
static tribox_status overlap_by(tribox_overlap_call *c, tribox_status checked, uint64_t *mask, tribox_report *report)
{
    return checked ? checked : tribox_call_may_code(c) ? overlap_coded(c, mask, report) : overlap_with(c, NULL, mask, report);
}

tribox_status tribox_overlap(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                             tribox_report *report)
{
    tribox_overlap_call c;
    return overlap_by(&c, tribox_call_check(&c, tribox_call_take_soup(&c, soup), box, options), mask, report);
}

tribox_status tribox_mesh_overlap(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                                  tribox_report *report)
{
    tribox_overlap_call c;
    return overlap_by(&c, tribox_call_check(&c, tribox_call_take_mesh(&c, mesh), box, options), mask, report);
}
