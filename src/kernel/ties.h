/*
 * ties.h - a second look at lanes that a margin leaves open although they certainly overlap.
 * After: axes.h, margin.h.
 *
 * Where the box normals do not separate, these axes are redundant and can be left out, by the certificate of overlap too (PROOFS.md
 * 2, 5.1): an edge whose own f_a or f_b is zero, in the projection on those axes, and the plane of a triangle that is flat on an
 * axis. An edge parallel to e_i has slack zero on a_ij wherever it lies, so without this no triangle with such an edge would be
 * certain. To test a redundant axis all the same would only leave more pairs open.
 */
TRIBOX_INLINE vmask is_positive(vnum a) { return v_gt(a, v_splat(0)); }

/* The certificate needs every extent to be zero or not too small (PROOFS.md 5.1). */
TRIBOX_INLINE vmask are_extents_certifiable(const lane_shape *s, const lane_box_margin *box)
{
    vmask certifiable = m_all();
    for (int a = 0; a < 3; a++) {
        const vnum sum = extent_sum(s, a);
        certifiable = m_andnot(certifiable, m_andnot(is_positive(sum), v_gt(sum, box->least)));
    }
    return certifiable;
}

/* Every edge axis is beyond its margin, or redundant (PROOFS.md 2). */
TRIBOX_INLINE vmask are_edges_certain(const lane_shape *s, const lane_margin *margin)
{
    vmask certain = m_all();
    for (int i = 0; i < 3; i++) {
        const edge_slacks slack = edge_slacks_along(s, i, true);
        for (int j = 0; j < 3; j++) {
            const vnum shorter = v_min(v_abs(s->f[j][(i + 1) % 3]), v_abs(s->f[j][(i + 2) % 3]));
            certain = m_andnot(certain, m_andnot(is_positive(shorter), v_gt(slack.of[j], margin->edges)));
        }
    }
    return certain;
}

/* The plane is beyond its margin, or redundant. */
TRIBOX_INLINE vmask is_plane_certain(const lane_shape *s, const lane_margin *margin)
{
    const vnum thinnest = lane_min3(extent_sum(s, 0), extent_sum(s, 1), extent_sum(s, 2));
    const vmask clear = v_gt(plane_slack(s, plane_reach(s)), margin->plane);
    return m_or(m_not(is_positive(thinnest)), clear);
}
