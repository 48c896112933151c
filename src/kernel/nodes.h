/*
 * nodes.h - a node of an index beside a box, child by child; and the table of what a kernel does about indices.
 * After: extents.h. Needs: KERNEL.
 *
 * Bounds and box are numbers of the input: every comparison is exact. Box and children are closed, so touching is not apart.
 */

TRIBOX_INLINE vmask is_apart(const vnum child[6], const vnum box[6])
{
    vmask apart = m_none();
    for (int a = 0; a < 3; a++)
        apart = m_or(apart, m_or(v_gt(child[a], box[3 + a]), v_gt(box[a], child[3 + a])));
    return apart;
}

TRIBOX_INLINE vmask is_beyond(const vnum child[6], const vnum box[6])
{
    vmask beyond = m_none();
    for (int a = 0; a < 3; a++)
        beyond = m_or(beyond, m_or(v_gt(box[a], child[a]), v_gt(child[3 + a], box[3 + a])));
    return beyond;
}

static tribox_touch touch(const tribox_node *node, const tribox_box *box)
{
    vnum bound[6], child[6];
    tribox_touch found = {0, 0};
    for (int a = 0; a < 3; a++) {
        bound[a] = v_splat(box->lo[a]);
        bound[3 + a] = v_splat(box->hi[a]);
    }
    for (int c = 0; c < 64; c += V_LANES) {
        for (int k = 0; k < 6; k++)
            child[k] = v_load(node->bound[k] + c);
        const vmask apart = is_apart(child, bound);
        found.touching |= (m_bits(apart) ^ LANES_ALL) << c;
        found.inside |= (m_bits(m_or(apart, is_beyond(child, bound))) ^ LANES_ALL) << c;
    }
    found.inside &= node->whole;
    return found;
}

extern const tribox_index_kernel TRIBOX_SYMBOL(index);
const tribox_index_kernel TRIBOX_SYMBOL(index) = {
    .bound_soup = bound_soup,
    .bound_nodes = bound_nodes,
    .touch = touch,
};
