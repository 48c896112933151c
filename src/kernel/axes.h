/*
 * axes.h - the thirteen axes, stated once, for every instruction set and every kind of number.
 * After: a vocabulary (the words v_ and m_, kernel/README.md), or a kind of integer (exact/num_*.h).
 *
 * T. Akenine-Moller, "Fast 3D Triangle-Box Overlap Testing", journal of graphics tools 6(1), 2001, section 2. A convex triangle and
 * a box are disjoint exactly when one of thirteen axes separates them:
 *   bullet 1   e_0, e_1, e_2           the box normals: the triangle's bounding box against the box
 *   bullet 2   n                       the triangle's normal: its plane against the box
 *   bullet 3   a_ij = e_i x f_j        nine cross products of box edges and triangle edges
 *
 *   paper                               here
 *   u_j   vertices as given             t->u[j][a], vertex j, axis a
 *   v_0   vertex 0 about the centre     s->V[a] = 2 (u_0 - lo) - (hi - lo) = 2 v_0: doubled, and no centre is rounded
 *   h     half lengths of the box       s->H[a] = 2 h_a = hi - lo
 *   f_j   edges v_(j+1) - v_j           s->f[j][a], from u, not from v: nothing is lost far from the origin
 *   n     f_0 x f_1                     s->n[a]
 *   p_j   projections of the vertices   on the axis of edge j, doubled: j and j + 1 are at -P_j, P_j = V_ja f_jb - V_jb f_ja, the
 *                                       third at -P_j + 2 n_i: side_of
 *   r     radius of the box             edge_slack, plane_slack: doubled likewise
 *
 * Every axis but the box normals answers with a slack: the reach of the box less the distance of the triangle, in doubled units.
 * A negative slack separates; touching is slack zero, and overlap.
 *
 * Deviations from the paper:
 * - The box is lo, hi and not centre, half: bullet 1 compares the numbers of the input themselves and is exact.
 * - Of the two sides of an edge axis only the outer one is tested, and the sign of n_i says which that is. One sign serves all
 *   three edges of a projection, and where n_i is zero it may be either. Together with bullet 1 the test is complete, for
 *   degenerate triangles and flat boxes too: PROOFS.md 1 proves it. Without bullet 1 the two-sided slacks are needed.
 * - Two products serve the three edges of a projection: with p = (V_0 x f_0)_i and q = (V_0 x f_1)_i, P_0 = p, P_1 = q + 2 n_i,
 *   P_2 = -(p + q). Only vertex 0 needs a V (PROOFS.md 1, consequence 5).
 */

/* A triangle in lanes: u[j][a] is axis a of vertex j. */
typedef struct lane_triangle {
    vnum u[3][3];
} lane_triangle;

/* A box in lanes. */
typedef struct lane_box {
    vnum lo[3], hi[3];
    vnum H[3];            /* |hi - lo|: +0, never -0, where both are zero */
    vnum origin[3], C[3]; /* what V_0 is taken from, and hi + lo - 2 origin: lo and H, unless a caller chooses another */
} lane_box;

/* What the axes share of a triangle and a box. */
typedef struct lane_shape {
    vnum V[3];    /* vertex 0 about the centre of the box, doubled */
    vnum H[3];    /* the lengths of the box */
    vnum f[3][3]; /* f[j][a]: edge from vertex j to vertex j + 1 */
    vnum l[3][3]; /* l[j][a]: its length on axis a, |f_ja| */
    vnum n[3];    /* the normal f_0 x f_1 */
} lane_shape;

TRIBOX_INLINE vnum lane_min3(vnum a, vnum b, vnum c) { return v_min(v_min(a, b), c); }
TRIBOX_INLINE vnum lane_max3(vnum a, vnum b, vnum c) { return v_max(v_max(a, b), c); }

/* Zero of finite numbers, NaN of others: a number minus itself. */
TRIBOX_INLINE vnum lane_lost3(vnum a, vnum b, vnum c) { return v_add(v_add(v_sub(a, a), v_sub(b, b)), v_sub(c, c)); }

TRIBOX_INLINE void set_bounds(lane_box *box, int a, vnum lo, vnum hi)
{
    box->lo[a] = box->origin[a] = lo;
    box->hi[a] = hi;
    box->H[a] = box->C[a] = v_abs(v_sub(hi, lo));
}

/* The part of a shape that needs one axis only: a caller may load x, y and z as it needs them. */
TRIBOX_INLINE void shape_axis(lane_shape *s, const lane_triangle *t, const lane_box *box, int a)
{
    s->H[a] = box->H[a];
    s->V[a] = v_fms(v_splat(2), v_sub(t->u[0][a], box->origin[a]), box->C[a]);
    for (int j = 0; j < 3; j++) {
        s->f[j][a] = v_sub(t->u[(j + 1) % 3][a], t->u[j][a]);
        s->l[j][a] = v_abs(s->f[j][a]);
    }
}

/* The rest of it, once all three axes are there: n_i, and all of n. */
TRIBOX_INLINE void shape_normal_along(lane_shape *s, int i)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    s->n[i] = v_fms(s->f[0][a], s->f[1][b], v_mul(s->f[0][b], s->f[1][a]));
}

TRIBOX_INLINE void shape_normal(lane_shape *s)
{
    for (int i = 0; i < 3; i++)
        shape_normal_along(s, i);
}

/* Bullet 1, axis e_a: which lanes are apart, all three vertices below the box or all three above it. */
TRIBOX_INLINE vmask apart_on_box_normal(const lane_triangle *t, const lane_box *box, int a)
{
    return m_or(v_gt(box->lo[a], lane_max3(t->u[0][a], t->u[1][a], t->u[2][a])),
                v_gt(lane_min3(t->u[0][a], t->u[1][a], t->u[2][a]), box->hi[a]));
}

/* Component i of V_0 x f_j: p for edge 0, q for edge 1. */
TRIBOX_INLINE vnum side_of(const lane_shape *s, int i, int j)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    return v_fms(s->V[a], s->f[j][b], v_mul(s->V[b], s->f[j][a]));
}

/*
 * Bullet 2, axis n: R - |d|, with R the reach of the box along n and d = n . V_0, both from one n and summed axis by axis. So where
 * the computed n is zero, as for many segments, it separates nothing (PROOFS.md 10).
 */
TRIBOX_INLINE vnum add_to_reach(const lane_shape *s, int i, vnum sum)
{
    const vnum n = v_abs(s->n[i]);
    return i == 0 ? v_mul(s->H[i], n) : v_fma(s->H[i], n, sum);
}

TRIBOX_INLINE vnum add_to_distance(const lane_shape *s, int i, vnum sum)
{
    return i == 0 ? v_mul(s->V[i], s->n[i]) : v_fma(s->V[i], s->n[i], sum);
}

TRIBOX_INLINE vnum plane_slack_of(vnum reach, vnum d) { return v_sub(reach, v_abs(d)); }

TRIBOX_INLINE vnum plane_reach(const lane_shape *s)
{
    return add_to_reach(s, 2, add_to_reach(s, 1, add_to_reach(s, 0, v_splat(0))));
}

TRIBOX_INLINE vnum plane_distance(const lane_shape *s)
{
    return add_to_distance(s, 2, add_to_distance(s, 1, add_to_distance(s, 0, v_splat(0))));
}

TRIBOX_INLINE vnum plane_slack(const lane_shape *s, vnum reach)
{
    const vnum d = plane_distance(s);
    return plane_slack_of(reach, d);
}

/* Bullet 3: what the axes a_i0, a_i1, a_i2 share, all turned by one sign so that n_i is positive. */
typedef struct lane_projection {
    vnum p, q, n;
} lane_projection;

TRIBOX_INLINE lane_projection projection_along(const lane_shape *s, int i)
{
    return (lane_projection){v_flip(side_of(s, i, 0), s->n[i]), v_flip(side_of(s, i, 1), s->n[i]), v_abs(s->n[i])};
}

/* One-sided: the box against the outer side of edge j. With bullets 1 and 2 this is the whole test (PROOFS.md 1). */
TRIBOX_INLINE vnum edge_slack(const lane_shape *s, const lane_projection *turned, int i, int j)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const vnum reach_b = j == 0   ? v_fma(s->H[b], s->l[j][a], turned->p)
                         : j == 1 ? v_fma(s->H[b], s->l[j][a], v_fma(v_splat(2), turned->n, turned->q))
                                  : v_fms(s->H[b], s->l[j][a], v_add(turned->p, turned->q));
    return v_fma(s->H[a], s->l[j][b], reach_b);
}

/* Two-sided, for axis sets without bullet 1 (PROOFS.md 1): the triangle spans [-P, -P + 2 n_i] on the axis. */
TRIBOX_INLINE vnum edge_slack_both_sides(const lane_shape *s, int i, int j)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const vnum p = side_of(s, i, 0), q = side_of(s, i, 1), n = s->n[i];
    const vnum middle = v_abs(j == 0 ? v_sub(n, p) : j == 1 ? v_add(n, q) : v_add(n, v_add(p, q)));
    return v_sub(v_fma(s->H[a], s->l[j][b], v_fma(s->H[b], s->l[j][a], v_abs(n))), middle);
}

/* The slacks of the axes a_i0, a_i1, a_i2. */
typedef struct edge_slacks {
    vnum of[3];
} edge_slacks;

TRIBOX_INLINE edge_slacks edge_slacks_along(const lane_shape *s, int i, bool is_box_asked)
{
    edge_slacks slack;
    if (is_box_asked) {
        const lane_projection turned = projection_along(s, i);
        for (int j = 0; j < 3; j++)
            slack.of[j] = edge_slack(s, &turned, i, j);
    } else {
        for (int j = 0; j < 3; j++)
            slack.of[j] = edge_slack_both_sides(s, i, j);
    }
    return slack;
}
