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
 *   v_j   vertices about the centre     s->V[j][a] = (u - lo) - (hi - u) = 2 v_j: doubled, and no centre is rounded
 *   h     half lengths of the box       s->H[a] = 2 h_a = hi - lo
 *   f_j   edges v_(j+1) - v_j           s->f[j][a], from u, not from v: nothing is lost far from the origin
 *   n     f_0 x f_1                     s->n[a]
 *   p_j   projections of the triangle   edge_slack: P = V_ja f_jb - V_jb f_ja, the projection of edge j, doubled
 *   r     radius of the box             edge_slack, plane_slack: doubled likewise
 *
 * Every axis but the box normals answers with a slack: the reach of the box less the distance of the triangle, in doubled units.
 * A negative slack separates; touching is slack zero, and overlap.
 *
 * Deviations from the paper:
 * - The box is lo, hi and not centre, half: bullet 1 compares the numbers of the input themselves and is exact, as the sign of a
 *   rounded difference is the sign of the difference.
 * - Of the two sides of an edge axis only the outer one is tested, and the sign of n_i says which that is. One sign serves all
 *   three edges of a projection, and where n_i is zero it may be either. With bullet 1 beside it the test is complete, for
 *   degenerate triangles and flat boxes too: PROOFS.md 1 proves it. Without bullet 1 the two-sided slacks are needed.
 * - An edge is projected by either of its ends, so vertices 0 and 1 serve all three edges, and vertex 2 needs no V.
 */

/* A triangle in lanes: u[j][a] is axis a of vertex j. */
typedef struct lane_triangle {
    vnum u[3][3];
} lane_triangle;

/* A box in lanes. */
typedef struct lane_box {
    vnum lo[3], hi[3];
    vnum H[3]; /* hi - lo */
} lane_box;

/* What the axes share of a triangle and a box. */
typedef struct lane_shape {
    vnum below[3][3]; /* below[j][a] = u - lo: negative where vertex j lies below the box */
    vnum above[3][3]; /* above[j][a] = hi - u: negative where it lies above */
    vnum V[2][3];     /* V[j][a]: vertex j about the centre of the box, doubled */
    vnum H[3];        /* the lengths of the box */
    vnum f[3][3];     /* f[j][a]: edge from vertex j to vertex j + 1 */
    vnum n[3];        /* the normal f_0 x f_1 */
} lane_shape;

TRIBOX_INLINE vnum lane_min3(vnum a, vnum b, vnum c) { return v_min(v_min(a, b), c); }
TRIBOX_INLINE vnum lane_max3(vnum a, vnum b, vnum c) { return v_max(v_max(a, b), c); }

/* The part of a shape that needs one axis only: a caller may load x, y and z as it needs them. */
TRIBOX_INLINE void shape_axis(lane_shape *s, const lane_triangle *t, const lane_box *box, int a)
{
    s->H[a] = box->H[a];
    for (int j = 0; j < 3; j++) {
        s->below[j][a] = v_sub(t->u[j][a], box->lo[a]);
        s->above[j][a] = v_sub(box->hi[a], t->u[j][a]);
        s->f[j][a] = v_sub(t->u[(j + 1) % 3][a], t->u[j][a]);
    }
    for (int j = 0; j < 2; j++)
        s->V[j][a] = v_sub(s->below[j][a], s->above[j][a]);
}

/* The rest of it, once all three axes are there. */
TRIBOX_INLINE void shape_normal(lane_shape *s)
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        s->n[i] = v_fms(s->f[0][a], s->f[1][b], v_mul(s->f[0][b], s->f[1][a]));
    }
}

/* Bullet 1, axis e_a: the sign bits tell which lanes are apart, all three vertices below the box or all three above it. */
TRIBOX_INLINE vnum apart_on_box_normal(const lane_shape *s, int a)
{
    return v_either(v_both(v_both(s->below[0][a], s->below[1][a]), s->below[2][a]),
                    v_both(v_both(s->above[0][a], s->above[1][a]), s->above[2][a]));
}

/*
 * A vertex in the closed box is a common point, whatever the axes. The sign bits show which lanes have none. A shortcut: an overlap
 * that it does not see is found by the slacks.
 */
TRIBOX_INLINE vnum has_no_vertex_inside(const lane_shape *s)
{
    vnum outside[3];
    for (int j = 0; j < 3; j++)
        outside[j] = v_either(v_either(v_either(s->below[j][0], s->below[j][1]), v_either(s->below[j][2], s->above[j][0])),
                              v_either(s->above[j][1], s->above[j][2]));
    return v_both(v_both(outside[0], outside[1]), outside[2]);
}

/* Bullet 2, axis n: R - |d|, with d = n . V_0 and R the reach of the box along n. */
TRIBOX_INLINE vnum plane_reach(const lane_shape *s)
{
    return v_fma(s->H[2], v_abs(s->n[2]), v_fma(s->H[1], v_abs(s->n[1]), v_mul(s->H[0], v_abs(s->n[0]))));
}

TRIBOX_INLINE vnum plane_slack(const lane_shape *s, vnum reach)
{
    const vnum d = v_fma(s->n[2], s->V[0][2], v_fma(s->n[1], s->V[0][1], v_mul(s->n[0], s->V[0][0])));
    return v_sub(reach, v_abs(d));
}

/* Bullet 3, axis a_ij = e_i x f_j: where edge j and the box lie in the projection along e_i. */
TRIBOX_INLINE vnum edge_projection(const lane_shape *s, int i, int j)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3, end = j == 1; /* edges 0 and 2 by vertex 0, which both have */
    return v_fms(s->V[end][a], s->f[j][b], v_mul(s->V[end][b], s->f[j][a]));
}

/* The reach of the box on a_ij, added to `to`. */
TRIBOX_INLINE vnum add_edge_reach(const lane_shape *s, int i, int j, vnum to)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    return v_fma(s->H[a], v_abs(s->f[j][b]), v_fma(s->H[b], v_abs(s->f[j][a]), to));
}

/* One-sided: the box against the outer side of edge j. With bullets 1 and 2 this is the whole test (PROOFS.md 1). */
TRIBOX_INLINE vnum edge_slack(const lane_shape *s, int i, int j)
{
    return add_edge_reach(s, i, j, v_flip(edge_projection(s, i, j), v_sign(s->n[i])));
}

/* Two-sided, for axis sets without bullet 1 (PROOFS.md 1): the triangle spans [-P, -P + 2 n_i] on the axis. */
TRIBOX_INLINE vnum edge_slack_both_sides(const lane_shape *s, int i, int j)
{
    const vnum middle = v_abs(v_sub(s->n[i], edge_projection(s, i, j)));
    return v_sub(add_edge_reach(s, i, j, v_abs(s->n[i])), middle);
}

/* The three axes a_i0, a_i1, a_i2 of the projection along e_i. */
TRIBOX_INLINE vnum edges_slack(const lane_shape *s, int i)
{
    return lane_min3(edge_slack(s, i, 0), edge_slack(s, i, 1), edge_slack(s, i, 2));
}

TRIBOX_INLINE vnum edges_slack_both_sides(const lane_shape *s, int i)
{
    return lane_min3(edge_slack_both_sides(s, i, 0), edge_slack_both_sides(s, i, 1), edge_slack_both_sides(s, i, 2));
}
