/*
 * The error bounds of CONSERVATIVE and EXACT, in the arithmetic of the vocabulary: unit roundoff V_UNIT, and V_ETA, V_TAU against
 * underflow (zero where nothing can underflow). Proofs: doc of the slacks in axes.h, and README "Why the answers may be trusted".
 *
 * With F_a the extent of the triangle on axis a and m_a = max(max_j u_ja - lo_a, hi_a - min_j u_ja), the farthest that triangle
 * and box reach from each other on that axis:
 *   edges of projection i   |error of a slack| <= 2 K u B_i + eta,   B_i = F_a m_b + F_b m_a,   K = 16 one-sided, 32 two-sided
 *   plane                   |error of a slack| <= 2 24 u S + eta,    S = sum over i of (F_a F_b + tau) m_i
 * The factor 2 stands for the doubled units. Seven roundings a monomial and the sign of n make 15 u, rounded up to 16; the plane
 * has 22 u, rounded up to 24. They hold with fused operations, without them and under any contraction.
 */

typedef struct lane_bounds {
    vnum F[3];     /* extents of the triangle */
    vnum edges[3]; /* bound on the one-sided slacks of projection i */
    vnum plane;    /* bound on the slack of the plane */
    vnum size;     /* a sum that exceeds every factor and product above */
} lane_bounds;

TRIBOX_INLINE lane_bounds bounds_of(const lane_triangle *t, const lane_box *box)
{
    lane_bounds bound;
    vnum m[3], S = v_splat(0);
    bound.size = v_splat(0);
    for (int a = 0; a < 3; a++) {
        const vnum least = lane_min3(t->u[0][a], t->u[1][a], t->u[2][a]);
        const vnum most = lane_max3(t->u[0][a], t->u[1][a], t->u[2][a]);
        bound.F[a] = v_sub(most, least);
        m[a] = v_max(v_sub(most, box->lo[a]), v_sub(box->hi[a], least));
        bound.size = v_add(bound.size, m[a]);
    }
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const vnum B = v_fma(bound.F[a], m[b], v_mul(bound.F[b], m[a]));
        S = v_fma(v_fma(bound.F[a], bound.F[b], v_splat(V_TAU)), m[i], S);
        bound.size = v_add(bound.size, B);
        bound.edges[i] = v_fma(v_splat(2 * 16 * V_UNIT), B, v_splat(V_ETA));
    }
    bound.plane = v_fma(v_splat(2 * 24 * V_UNIT), S, v_splat(V_ETA));
    bound.size = v_add(bound.size, S);
    return bound;
}

/* The bound on the two-sided slacks is twice that of the one-sided ones; it may count eta twice. */
TRIBOX_INLINE vnum both_sides_bound(const lane_bounds *bound, int i) { return v_add(bound->edges[i], bound->edges[i]); }
