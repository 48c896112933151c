/*
 * bounds.h - how far rounding can move a slack, in the arithmetic of the vocabulary: u is its unit roundoff, V_UNIT.
 * After: axes.h.
 *
 * With F_a the extent of the triangle on axis a and m_a = max(max_j u_ja - lo_a, hi_a - min_j u_ja), the largest distance between
 * a point of the triangle and a point of the box on that axis:
 *   edges of projection i   2 16 u B_i + eta,  B_i = F_a m_b + F_b m_a
 *   plane                   2 24 u S + eta,    S = sum over i of (F_a F_b + tau) m_i
 * The factor 2 stands for the doubled units. Needed are 8 u (2 B_i) for the roundings of a one-sided slack, 10 where they turn the
 * sign of n_i, 10.5 for a two-sided slack, and 11 u (2 S) for the plane: the text counts that itself (PROOFS.md 3.8).
 *
 * eta and tau stand for underflow in float (PROOFS.md 3.7) and are zero in double (6.1).
 *
 * A slack below minus its bound separates (3.4). If all are above their bounds, triangle and box overlap, in float provided that
 * every F_a is 0 or at least 2^-55 (5.1). The extents come from the input: from rounded V they could all vanish.
 */

/* The bounds where nothing underflows. */
typedef struct lane_bounds {
    vnum F[3];     /* extents of the triangle */
    vnum m[3];     /* the largest distances */
    vnum edges[3]; /* bound on the slacks of projection i, of one side or both */
    vnum plane;    /* bound on the slack of the plane */
} lane_bounds;

TRIBOX_INLINE lane_bounds bounds_of(const lane_triangle *t, const lane_box *box)
{
    lane_bounds bound;
    vnum S = v_splat(0);
    for (int a = 0; a < 3; a++) {
        const vnum least = lane_min3(t->u[0][a], t->u[1][a], t->u[2][a]);
        const vnum most = lane_max3(t->u[0][a], t->u[1][a], t->u[2][a]);
        bound.F[a] = v_sub(most, least);
        bound.m[a] = v_max(v_sub(most, box->lo[a]), v_sub(box->hi[a], least));
    }
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const vnum B = v_fma(bound.F[a], bound.m[b], v_mul(bound.F[b], bound.m[a]));
        S = v_fma(v_mul(bound.F[a], bound.F[b]), bound.m[i], S);
        bound.edges[i] = v_mul(v_splat(2 * 16 * V_UNIT), B);
    }
    bound.plane = v_mul(v_splat(2 * 24 * V_UNIT), S);
    return bound;
}
