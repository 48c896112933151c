/* mesh.c - triangles by index, or nine floats each, as they lie in memory: block by block to the kernels. */
#include "base/box.h"
#include "base/environment.h"
#include "pairs/partial_packet.h"
#include "mesh_blocks.h"
#include "mesh_input.h"
#include "pairs/pairs.h"

/* Adds what a part of a call has found. */
static void add(tribox_report *counts, tribox_report part)
{
    counts->overlapping += part.overlapping;
    counts->undecided += part.undecided;
}

/* At most TRIBOX_MESH_STREAMED triangles, by way of streams. */
static tribox_report answer_streams(const tribox_mesh *mesh, size_t first, size_t count, const tribox_box *box, tribox_plan *plan,
                                    uint64_t *mask)
{
    _Alignas(64) float streams[9][TRIBOX_MESH_STREAMED]; /* no packet in two lines of the cache */
    float *to[9];
    tribox_partial_packet partial;
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    plan->kernel->gather(mesh, NULL, first, count, to);
    const tribox_soup soup = tribox_soup_of(&streams[0][0], TRIBOX_MESH_STREAMED, count);
    const tribox_query pairs = {.soup = tribox_pad_triangles(&soup, plan->kernel, &partial), .box = box, .count = count};
    return tribox_pairs_answer(&pairs, plan, mask);
}

static tribox_box_pattern box_pattern_of(const tribox_box *box)
{
    tribox_box_pattern pattern = {.origin = NULL};
    for (int k = 0; k < 3 * TRIBOX_LANES_MAX; k++) {
        pattern.lo[k] = box->lo[k % 3];
        pattern.hi[k] = box->hi[k % 3];
    }
    return pattern;
}

/* From where they lie to registers if all of the block can be read so, else the first by way of streams. */
static size_t answer_mesh_block(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                tribox_report *counts)
{
    uint32_t offset[3 * TRIBOX_MESH_BLOCK];
    tribox_corners corners;
    tribox_plan *const plan = q->plan;
    const tribox_box *const box = q->about;
    const size_t streamed = count < TRIBOX_MESH_STREAMED ? count : TRIBOX_MESH_STREAMED;
    if (plan->kernel->find_corners(mesh, first, count, offset, &corners) >= mesh->vertices)
        return 0;
    const tribox_query pairs = {.corners = &corners, .box = box, .count = count};
    const bool is_direct = !TRIBOX_WALKS_SOUPS_ALONE && corners.base && corners.has_all && plan->axes == TRIBOX_AXES_ALL &&
                           count >= plan->kernel->lanes;
    add(counts, is_direct ? tribox_pairs_answer(&pairs, plan, mask) : answer_streams(mesh, first, streamed, box, plan, mask));
    return is_direct ? count : streamed;
}

tribox_status tribox_overlap_indexed(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                                     tribox_report *report)
{
    if (!box || !tribox_mesh_is_readable(mesh))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    const tribox_mesh strided = tribox_mesh_with_strides(mesh);
    const tribox_box_pattern pattern = box_pattern_of(box);
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    const tribox_mesh_query query = {.answer = answer_mesh_block,
                                     .plan = &plan,
                                     .pattern = plan.axes & TRIBOX_AXES_BOX ? &pattern : NULL,
                                     .is_empty = tribox_box_is_empty(box),
                                     .about = box};
    const bool is_answered = tribox_mesh_answer(&query, &strided, mask, &counts);
    tribox_environment_leave(callers);
    if (!is_answered)
        return TRIBOX_BAD_VERTEX;
    tribox_plan_report(&plan, counts, report);
    return TRIBOX_OK;
}
