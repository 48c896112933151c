/*
 * ties.h - slacks without redundant axes, for a second look at lanes that a margin leaves undecided although they certainly
 * overlap. After: axes.h, margin.h. Needs: v_drop.
 *
 * Where the box normals do not separate, these axes are redundant and can be left out, by the certificate of overlap too (PROOFS.md
 * 2, 5.1): an edge whose own f_a or f_b is zero, in the projection on those axes, and the plane of a triangle that is flat on an
 * axis. An edge parallel to e_i has slack zero on a_ij wherever it lies, so without this no triangle with such an edge would be
 * certain. To test a redundant axis all the same would only leave more pairs undecided.
 */

/* NaN for every length on axis a that is zero: the slack of a redundant edge axis is then NaN, which v_min leaves out. */
TRIBOX_INLINE void drop_zero_lengths(lane_shape *s, int a)
{
    for (int j = 0; j < 3; j++)
        s->l[j][a] = v_drop(v_is_zero(s->f[j][a]), s->l[j][a]);
}

/* The least of `worst`, which is no NaN, and of the slacks that are none. */
TRIBOX_INLINE vnum least_number(const edge_slacks *slack, vnum worst)
{
    return v_min(slack->of[0], v_min(slack->of[1], v_min(slack->of[2], worst)));
}

/* The slack of the plane, infinite where it is redundant. */
TRIBOX_INLINE vnum plane_slack_not_redundant(const lane_shape *s, vnum slack)
{
    const vmask is_flat = v_is_zero(lane_min3(extent_sum(s, 0), extent_sum(s, 1), extent_sum(s, 2)));
    return v_select(is_flat, v_splat(INFINITY), slack);
}

/* The certificate needs every extent to be zero or not too small (PROOFS.md 5.1). */
TRIBOX_INLINE vmask are_extents_certifiable(const lane_shape *s, const lane_box_margin *box)
{
    vmask certifiable = m_all();
    for (int a = 0; a < 3; a++) {
        const vnum sum = extent_sum(s, a);
        certifiable = m_and(certifiable, m_or(v_is_zero(sum), v_gt(sum, box->least)));
    }
    return certifiable;
}
