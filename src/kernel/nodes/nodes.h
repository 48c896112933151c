/*
 * nodes.h - a node of an index against a box, child by child.
 * After: axes.h.
 *
 * Bounds and box are numbers of the input: every comparison is exact. Box and children are closed, so touching is not apart
 * (PROOFS.md 13.2, 13.3).
 */

/* Bounds in lanes, in the order of a node. */
typedef struct lane_bound {
    vnum of[6];
} lane_bound;

TRIBOX_INLINE lane_bound bound_of_box(const tribox_rounded_box *box)
{
    lane_bound bound;
    for (int a = 0; a < 3; a++) {
        bound.of[a] = v_splat(box->lo[a]);
        bound.of[3 + a] = v_splat(box->hi[a]);
    }
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

static tribox_touch touch(const tribox_node *node, unsigned count, const tribox_rounded_box *box)
{
    const lane_bound bound = bound_of_box(box);
    tribox_touch found = {0, 0};
    for (int c = 0; c < (int)count; c += V_LANES) {
        const lane_bound child = bound_of_children(node, c);
        const vmask apart = is_apart(&child, &bound);
        found.touching |= (m_bits(apart) ^ LANES_ALL) << c;
        found.inside |= (m_bits(m_or(apart, is_beyond(&child, &bound))) ^ LANES_ALL) << c;
    }
    found.inside &= node->whole;
    return found;
}

/* Halves are added, as their sum cannot overflow, and not fused, so that every kernel finds the same. */
static uint64_t find_centred(const tribox_node *node, const tribox_rounded_box *box)
{
    const lane_bound bound = bound_of_box(box);
    uint64_t found = 0;
    for (int c = 0; c < 64; c += V_LANES) {
        const lane_bound child = bound_of_children(node, c);
        lane_bound middle;
        for (int a = 0; a < 3; a++)
            middle.of[a] = middle.of[3 + a] = v_add(v_mul(v_splat(0.5f), child.of[a]), v_mul(v_splat(0.5f), child.of[3 + a]));
        found |= (m_bits(is_apart(&middle, &bound)) ^ LANES_ALL) << c;
    }
    return found;
}
