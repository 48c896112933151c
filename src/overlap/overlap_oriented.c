/* overlap_oriented.c - which triangles overlap an oriented box: the calls. */
#include "base/environment.h"
#include "mesh/mesh_input.h"
#include "pairs/pairs.h"
#include "pairs/partial_packet.h"

/* Triangles of a soup, or where that is NULL of a mesh whose strides are set; is_taken: whether they can be read. */
static tribox_status overlap_oriented(const tribox_soup *soup, const tribox_mesh *mesh, const tribox_oriented_box *box,
                                      const tribox_options *options, uint64_t *mask, tribox_report *report)
{
    tribox_mesh strided;
    if (!box || !(mesh ? tribox_mesh_take(mesh, &strided) : tribox_soup_is_readable(soup)))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_oriented_is_finite(box))
        return TRIBOX_BAD_BOX;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    if (!tribox_oriented_has_axes(&plan))
        return TRIBOX_BAD_OPTION;
    tribox_box upright;
    if (plan.accuracy == TRIBOX_EXACT && tribox_oriented_is_upright(box, &upright)) /* others need not answer alike */
        return soup ? tribox_overlap(soup, &upright, options, mask, report)
                    : tribox_mesh_overlap(mesh, &upright, options, mask, report);
    if (!soup && !tribox_mesh_is_in_range(&strided, plan.kernel, 0, mesh->count))
        return TRIBOX_BAD_VERTEX;

    tribox_partial_packet partial;
    tribox_oriented_query q;
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    if (tribox_oriented_is_empty(box)) {
        tribox_pairs_write_none(soup ? soup->count : mesh->count, mask);
    } else {
        if (soup)
            tribox_oriented_ask_soup(&q, tribox_pad_triangles(soup, plan.kernel, &partial), box, &plan);
        else
            tribox_oriented_ask_mesh(&q, &strided, box, &plan);
        counts = tribox_oriented_answer_all(&q, mask);
    }
    tribox_environment_leave(callers);
    tribox_plan_report(&plan, counts, report);
    return TRIBOX_OK;
}

tribox_status tribox_overlap_oriented(const tribox_soup *soup, const tribox_oriented_box *box, const tribox_options *options,
                                      uint64_t *mask, tribox_report *report)
{
    return overlap_oriented(soup, NULL, box, options, mask, report);
}

tribox_status tribox_mesh_overlap_oriented(const tribox_mesh *mesh, const tribox_oriented_box *box, const tribox_options *options,
                                           uint64_t *mask, tribox_report *report)
{
    return overlap_oriented(NULL, mesh, box, options, mask, report);
}
