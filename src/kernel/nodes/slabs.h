/*
 * slabs.h - a node of an index against an oriented box: its children's bounds between the three slabs, with what rounding can do.
 * After: frame.h, nodes.h.
 *
 * On each axis of the box the bounds of a child reach from one corner to the opposite one. Both are moved into the frame like
 * vertices. What is then apart is apart, and what is inside by more than the bound is inside (PROOFS.md 8.3).
 */

/* The span of children on axis k of the frame; those with NaN or a bound too large for float are not tame. */
typedef struct lane_span {
    vnum least, most, error;
    vmask is_tame;
} lane_span;

/* is_up[a]: the axis points up along a, so that the lowest corner has the lower bound there. The same for all lanes. */
TRIBOX_INLINE lane_span span_in_frame(const lane_bound *child, const lane_frame *frame, int k, const bool is_up[3])
{
    vnum least[3], most[3], farthest[3];
    lane_span span;
    for (int a = 0; a < 3; a++) {
        const vnum lower = v_sub(child->of[a], frame->center[a]), upper = v_sub(child->of[3 + a], frame->center[a]);
        least[a] = is_up[a] ? lower : upper;
        most[a] = is_up[a] ? upper : lower;
        farthest[a] = v_max(v_abs(lower), v_abs(upper));
    }
    span.least = dot3(frame->axis[k], least);
    span.most = dot3(frame->axis[k], most);
    span.error = frame_error(frame, k, farthest);
    span.is_tame = v_gt(v_splat(FRAME_LIMIT), span.error);
    return span;
}

/* The lanes whose span is certainly within the slab. */
TRIBOX_INLINE vmask within_slab(const lane_frame *frame, int k, const lane_span *span)
{
    const vmask is_below = v_gt(frame->inner_hi[k], v_add(span->most, span->error));
    const vmask is_above = v_gt(v_sub(span->least, span->error), frame->inner_lo[k]);
    return m_and(span->is_tame, m_and(is_below, is_above));
}

static tribox_touch touch_oriented(const tribox_node *node, unsigned count, const tribox_rounded_frame *box)
{
    lane_frame frame;
    tribox_touch found = {0, 0};
    splat_frame(&frame, box);
    for (int c = 0; c < (int)count; c += V_LANES) {
        const lane_bound child = bound_of_children(node, c);
        vmask apart = m_none(), within = m_all();
        for (int k = 0; k < 3; k++) {
            const bool is_up[3] = {box->axis[k][0] > 0, box->axis[k][1] > 0, box->axis[k][2] > 0};
            const lane_span span = span_in_frame(&child, &frame, k, is_up);
            apart = m_or(apart, m_and(span.is_tame, apart_in_frame(&frame, k, span.least, span.most, span.error)));
            within = m_and(within, within_slab(&frame, k, &span));
        }
        found.touching |= (m_bits(apart) ^ LANES_ALL) << c;
        found.inside |= m_bits(m_andnot(within, apart)) << c;
    }
    found.inside &= node->whole;
    return found;
}
