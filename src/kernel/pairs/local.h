/*
 * local.h - triangles of doubles, rounded relative to the lower corner of their box: what that leaves in doubt.
 * After: axes.h, margin.h.
 *
 * A vertex is w = u - lo, taken in double and then rounded to float; the box is that from 0 to H, hi - lo rounded likewise. With
 * these the bounds of margin.h hold for the doubles: they have room for moving the triangle by 2^-24 of its distance, if no side of
 * the box is thinner than twice that (PROOFS.md 14.2, 14.3). Box normals compare numbers that are rounded, which keeps their order.
 * Only lanes where rounding may have made a vertex touch are in doubt (14.1).
 */

/* Known to begin at zero, which saves a difference and a constant. */
TRIBOX_INLINE void local_box_at_zero(lane_box *box)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = box->origin[a] = v_splat(0);
        box->C[a] = box->H[a];
    }
}

/* The most of sigma where rounding moves triangles by less than half the thinnest side of a box. */
TRIBOX_INLINE vnum local_most(vnum thinnest, vnum longest) { return v_fms(v_splat(1 / (16 * V_UNIT)), thinnest, longest); }

/* The box's margin, for such triangles. */
TRIBOX_INLINE lane_box_margin local_margin_of(const lane_box *box)
{
    const vnum thinnest = lane_min3(box->H[0], box->H[1], box->H[2]), longest = lane_max3(box->H[0], box->H[1], box->H[2]);
    lane_box_margin margin = box_margin_of(box);
    margin.most = v_min(margin.most, local_most(thinnest, longest));
    return margin;
}

/* Of the lanes that the normal of axis a does not separate, those where it certainly does not: points above lo, and below hi. */
TRIBOX_INLINE vmask is_clear(const lane_triangle *t, const lane_box *box, int a)
{
    return m_and(v_gt(lane_max3(t->u[0][a], t->u[1][a], t->u[2][a]), v_splat(0)),
                 v_gt(box->hi[a], lane_min3(t->u[0][a], t->u[1][a], t->u[2][a])));
}
