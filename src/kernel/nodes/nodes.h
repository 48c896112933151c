/*
 * nodes.h - a node of an index against a box, child by child.
 * After: axes.h.
 *
 * Of floats, bounds and box are numbers of the input, or stand for them: every comparison is exact. Of doubles, both have been
 * rounded so that what is apart is apart, and what lies inside lies inside. Box and children are closed, so touching is not apart
 * (PROOFS.md 13.2, 13.3, 13.5).
 */

/* Bounds in lanes, in the order of a node. */
typedef struct lane_bound {
    vnum of[6];
} lane_bound;

TRIBOX_INLINE lane_bound splat_bound(const float of[6])
{
    lane_bound bound;
    for (int k = 0; k < 6; k++)
        bound.of[k] = v_splat(of[k]);
    return bound;
}

TRIBOX_INLINE lane_bound bound_of_children(const tribox_node *node, int first)
{
    lane_bound bound;
    for (int k = 0; k < 6; k++)
        bound.of[k] = v_load(node->bound[k] + first);
    return bound;
}

TRIBOX_INLINE vmask is_apart(const lane_bound *child, const lane_bound *box)
{
    vmask apart = m_none();
    for (int a = 0; a < 3; a++)
        apart = m_or(apart, m_or(v_gt(child->of[a], box->of[3 + a]), v_gt(box->of[a], child->of[3 + a])));
    return apart;
}

TRIBOX_INLINE vmask is_beyond(const lane_bound *child, const lane_bound *box)
{
    vmask beyond = m_none();
    for (int a = 0; a < 3; a++)
        beyond = m_or(beyond, m_or(v_gt(box->of[a], child->of[a]), v_gt(child->of[3 + a], box->of[3 + a])));
    return beyond;
}

static tribox_touch touch(const tribox_node *node, unsigned count, const tribox_node_box *box)
{
    const lane_bound outer = splat_bound(box->outer), inner = splat_bound(box->inner);
    tribox_touch found = {0, 0};
    for (int c = 0; c < (int)count; c += V_LANES) {
        const lane_bound child = bound_of_children(node, c);
        const vmask apart = is_apart(&child, &outer);
        found.touching |= (m_bits(apart) ^ LANES_ALL) << c;
        found.inside |= (m_bits(m_or(apart, is_beyond(&child, &inner))) ^ LANES_ALL) << c;
    }
    found.inside &= node->whole;
    return found;
}

/* Halves are added, as their sum cannot overflow, and not fused, so that every kernel finds the same. */
static uint64_t find_centred(const tribox_node *node, const tribox_node_box *box)
{
    const lane_bound outer = splat_bound(box->outer);
    uint64_t found = 0;
    for (int c = 0; c < 64; c += V_LANES) {
        const lane_bound child = bound_of_children(node, c);
        lane_bound middle;
        for (int a = 0; a < 3; a++)
            middle.of[a] = middle.of[3 + a] = v_add(v_mul(v_splat(0.5f), child.of[a]), v_mul(v_splat(0.5f), child.of[3 + a]));
        found |= (m_bits(is_apart(&middle, &outer)) ^ LANES_ALL) << c;
    }
    return found;
}
