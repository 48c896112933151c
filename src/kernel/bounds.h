/*
 * The error bounds of CONSERVATIVE and EXACT, in the arithmetic of the vocabulary: unit roundoff u = V_UNIT, and V_ETA, V_TAU
 * against underflow (zero where nothing can underflow).
 *
 * With F_a the extent of the triangle on axis a and m_a = max(max_j u_ja - lo_a, hi_a - min_j u_ja), the farthest that triangle
 * and box reach from each other on that axis:
 *   edges of projection i   |error of a slack| <= 2 K u B_i + eta,   B_i = F_a m_b + F_b m_a,   K = 16 one-sided, 32 two-sided
 *   plane                   |error of a slack| <= 2 24 u S + eta,    S = sum over i of (F_a F_b + tau) m_i
 * The factor 2 stands for the doubled units. Counting roundings a monomial, the worst of fused and not: an edge axis has 7 u B'
 * (B' = 2 B_i: 5 for products with V or H, 2 for V itself), and a sign of n_i that rounding turned costs 8 u B' more, as then
 * |n_i| <= 8 u F_a F_b; 15 u, rounded up to 16. The plane has 11 u times |n| <= 2 F_a F_b: 22 u, rounded up to 24. At most ten
 * products underflow, each by 2^-150, which eta covers; tau covers an n that underflows and then meets a large V.
 *
 * A slack beyond its bound has the sign of the true slack. A negative one separates. All of them positive is overlap if besides
 * every F_a is 0 or at least 2^-55: a turned sign of n_i then still leaves a slack below 9 u B' on some edge, which the bound
 * exceeds. The extents come from the input: from rounded V they could all vanish.
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

/*
 * One bound for all nine edge axes and one for the plane, cheaper and coarser: from the sum of the extents alone. It needs the box
 * normals in the axis set, and holds for the lanes that they leave, as there m_a <= F_a + H_a. With s = F_x + F_y + F_z, h the
 * longest side of the box, and the geometric means at their largest:
 *   B_i <= s s / 2 + s h     S <= s s s / 9 + h s s / 3 + tau (s + 3 h) <= s / 3 (s s / 2 + s h) + tau (s + 3 h)
 * so the bound on the plane, 48 u S, is at most s times the bound on the edges, 32 u B_i, with room for the roundings of these
 * lines; 34 for 32 makes room in the other. Neither is ever below the finer bound. sigma >= s is the sum over the axes of
 * |f_0a| + |f_1a|, which no NaN and no infinity can leave finite.
 */
typedef struct lane_margin {
    vmask holds; /* finite, and small enough that no product overflows */
    vmask sound; /* and wide enough for the certificate of overlap */
    vnum edges, plane;
} lane_margin;

/* The terms of a margin that come from the box alone. */
typedef struct lane_box_margin {
    vnum most;  /* of sigma */
    vnum least; /* of every |f_0a| + |f_1a| */
    vnum edges; /* of the coefficient of sigma */
    vnum eta;   /* of the plane, with what tau comes to */
} lane_box_margin;

/*
 * The certificate asks F_a >= 2^-55, but only where a bound of the box lies between the least and the greatest u_ja: elsewhere the
 * box spans the triangle on axis a, and no edge separates in a projection that has it. Two floats less than 2^-55 apart are below
 * 2^-31, so a box without a bound that small asks nothing: least is then negative.
 */
TRIBOX_INLINE vnum least_extent(const lane_box *box)
{
    const vnum nearest = v_min(lane_min3(v_abs(box->lo[0]), v_abs(box->lo[1]), v_abs(box->lo[2])),
                               lane_min3(v_abs(box->hi[0]), v_abs(box->hi[1]), v_abs(box->hi[2])));
    return v_min(v_mul(v_sub(v_splat(0x1p-31f), nearest), v_splat(0x1p60f)), v_splat(0x1p-54f));
}

TRIBOX_INLINE lane_box_margin box_margin_of(const lane_box *box)
{
    const vnum h = lane_max3(box->H[0], box->H[1], box->H[2]);
    return (lane_box_margin){
        .most = v_sub(v_splat(0x1p38f), h),
        .least = least_extent(box),
        .edges = v_mul(h, v_splat(34 * V_UNIT)),
        .eta = v_fma(h, v_splat(0x1p-125f), v_splat(V_ETA)),
    };
}

TRIBOX_INLINE lane_margin margin_of(const lane_shape *s, const lane_box_margin *box)
{
    vnum sum[3];
    for (int a = 0; a < 3; a++)
        sum[a] = v_add(v_abs(s->f[0][a]), v_abs(s->f[1][a]));
    const vnum sigma = v_add(v_add(sum[0], sum[1]), sum[2]);
    const vnum edges = v_fma(sigma, v_fma(sigma, v_splat(17 * V_UNIT), box->edges), v_splat(V_ETA));
    const vmask holds = v_gt(box->most, sigma);
    return (lane_margin){
        .holds = holds,
        .sound = m_and(holds, v_gt(lane_min3(sum[0], sum[1], sum[2]), box->least)),
        .edges = edges,
        .plane = v_fma(sigma, edges, box->eta),
    };
}
