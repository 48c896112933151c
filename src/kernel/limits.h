/*
 * limits.h - the limits that each axis puts on the cells that triangles overlap, triangle by lane.
 * After: axes.h. Needs: v_div.
 *
 * In places (kernel_voxels.h) a cell is a unit cube, plane p of an axis lies at p and vertex j at g_j; f_j and n are made from
 * these. The shadow along an axis lies on the two others, q and p, and n = f_0q f_1p - f_0p f_1q, s its sign. Edge j says that a
 * cell overlaps only if, with m_q = s f_jp, m_p = -s f_jq and X the corner of the cell that is least along m,
 *   m_q (g_jq - X_q) + m_p (g_jp - X_p) >= 0
 * which is half the slack of axes.h (PROOFS.md 7.5). X is a cell's index, or that plus one: the left side is linear in the cell. So
 * it limits the cells along q in each row p. The plane limits them along x:
 *   n . (g_0 - X) >= 0 >= n . (g_0 - Y)       X the corner of least n . x, Y the opposite one
 *
 * Error bounds (PROOFS.md 7.2, 7.6, 7.7), u the unit roundoff. With F the extent of the triangle on an axis and R = F + cells + 2,
 * |g - X| <= R. A place and the plane that it is compared with are off by at most E = error + 4 u (base + R) together, the left
 * side of an edge by
 *   W = F_p (E_q + 128 u R_q) + F_q (E_p + 128 u R_p)
 * which also covers a sign of n that rounding turns, and the plane by
 *   sum of |n_a| E_a + 256 u S     S = sum of F_a F_b R_i
 * Divided by |m_q| or |n_x| these bound a limit. Where n_x is below 32 u S / R_x, that is used in its place. FAST keeps 256 u S:
 * without it a segment, whose n is zero, would be lost. Of these 30 u are needed for an edge and 62 u S for the plane.
 *
 * Redundant axes are left out (PROOFS.md 2): they are the ties of scenes that lie in the grid's own planes.
 */

/* One axis of a triangle in places, counted from its first cell. */
typedef struct lane_places {
    vnum f[3], g[3]; /* edges and vertices */
    vnum F, R, E;
} lane_places;

TRIBOX_INLINE lane_places places_of(const vnum u[3], vnum base, vnum cells, vnum origin, vnum per_cell, vnum error)
{
    lane_places p;
    for (int j = 0; j < 3; j++) {
        p.f[j] = v_mul(v_sub(u[(j + 1) % 3], u[j]), per_cell);
        p.g[j] = v_sub(v_mul(v_sub(u[j], origin), per_cell), base);
    }
    p.F = lane_max3(v_abs(p.f[0]), v_abs(p.f[1]), v_abs(p.f[2]));
    p.R = v_add(v_add(p.F, cells), v_splat(2));
    p.E = v_fma(v_add(base, p.R), v_splat(4 * V_UNIT), error);
    return p;
}

TRIBOX_INLINE vmask is_not_zero(vnum a) { return v_gt(v_abs(a), v_splat(0)); }

/* The cross product of the first two edges: a part of the normal. */
TRIBOX_INLINE vnum shadow_normal(const lane_places *q, const lane_places *p)
{
    return v_fms(q->f[0], p->f[1], v_mul(p->f[0], q->f[1]));
}

TRIBOX_INLINE vnum shadow_error(const lane_places *q, const lane_places *p)
{
    const vnum rounding = v_splat(128 * V_UNIT);
    return v_fma(p->F, v_fma(q->R, rounding, q->E), v_mul(q->F, v_fma(p->R, rounding, p->E)));
}

/* The axis of edge j: m, and the left side for cell (0, 0). It is redundant where either part of m is zero. */
typedef struct shadow_axis {
    vnum m_q, m_p, slack;
} shadow_axis;

/* m (g - X): X is the upper plane of cell 0 where m is negative. */
TRIBOX_INLINE vnum from_corner(vnum g, vnum m) { return v_fms(m, g, v_min(m, v_splat(0))); }

TRIBOX_INLINE shadow_axis shadow_axis_of(const lane_places *q, const lane_places *p, int j, vnum n)
{
    const vnum m_q = v_flip(p->f[j], n), m_p = v_flip(q->f[j], v_flip(n, v_splat(-0.0f)));
    return (shadow_axis){m_q, m_p, v_add(from_corner(q->g[j], m_q), from_corner(p->g[j], m_p))};
}

/*
 * Limits on cells: one more than places, so that cutting off the fraction rounds up; NaN where there are none. Of the three
 * edges at most two are upper and at most two lower; one may fill both places (PROOFS.md 7.5).
 */
typedef struct shadow_limit {
    vnum slope, maybe, certain;
} shadow_limit;
typedef struct shadow_limits {
    shadow_limit upper[2], lower[2];
} shadow_limits;

TRIBOX_INLINE shadow_limit select_limit(vmask m, const shadow_limit *a, const shadow_limit *b)
{
    return (shadow_limit){v_select(m, a->slope, b->slope), v_select(m, a->maybe, b->maybe), v_select(m, a->certain, b->certain)};
}

/* NaN, which `narrow` leaves out. */
TRIBOX_INLINE shadow_limit drop_limit(vmask m, const shadow_limit *a)
{
    return (shadow_limit){a->slope, v_drop(m, a->maybe), v_drop(m, a->certain)};
}

/* Those of edge j: an upper one where m_q > 0, a lower one where m_q < 0. */
typedef struct edge_limits {
    vnum m_q;
    shadow_limit upper, lower;
} edge_limits;

TRIBOX_INLINE edge_limits limits_of_edge(const lane_places *q, const lane_places *p, int j, vnum n, vnum error)
{
    const shadow_axis axis = shadow_axis_of(q, p, j, n);
    const vnum per_m = v_div(v_splat(1), axis.m_q);
    const vnum at = v_fma(axis.slack, per_m, v_splat(1)), slope = v_mul(v_sub(v_splat(0), axis.m_p), per_m);
    const vnum off = v_mul(error, v_abs(per_m));
    return (edge_limits){axis.m_q, {slope, v_add(at, off), v_sub(at, off)}, {slope, v_sub(at, off), v_add(at, off)}};
}

TRIBOX_INLINE shadow_limits limits_of(const lane_places *q, const lane_places *p, vnum bound_scale, vmask asked)
{
    const vnum zero = v_splat(0);
    const vnum n = shadow_normal(q, p), error = v_mul(bound_scale, shadow_error(q, p));
    edge_limits edge[3];
    vmask is_upper[3], is_lower[3];
    for (int j = 0; j < 3; j++) {
        edge[j] = limits_of_edge(q, p, j, n, error);
        const vmask is_asked = m_and(asked, is_not_zero(q->f[j])); /* m_q is not zero, or neither an upper nor a lower one */
        is_upper[j] = m_and(is_asked, v_gt(edge[j].m_q, zero));
        is_lower[j] = m_and(is_asked, v_gt(zero, edge[j].m_q));
    }
    const shadow_limit third_upper = drop_limit(m_not(is_upper[2]), &edge[2].upper);
    const shadow_limit third_lower = drop_limit(m_not(is_lower[2]), &edge[2].lower);
    shadow_limits limits;
    for (int j = 0; j < 2; j++) {
        limits.upper[j] = select_limit(is_upper[j], &edge[j].upper, &third_upper);
        limits.lower[j] = select_limit(is_lower[j], &edge[j].lower, &third_lower);
    }
    return limits;
}

/* The shadow keeps cells where at + q_slope q + p_slope p >= 0, up to its error: for taking or leaving whole rows (bricks.h). */
typedef struct shadow_side {
    vnum at, q_slope, p_slope;
} shadow_side;

TRIBOX_INLINE shadow_side side_of_shadow(const lane_places *q, const lane_places *p, int j, vmask asked)
{
    const vnum zero = v_splat(0);
    const shadow_axis axis = shadow_axis_of(q, p, j, shadow_normal(q, p));
    const vmask is_asked = m_and(asked, m_and(is_not_zero(p->f[j]), is_not_zero(q->f[j])));
    return (shadow_side){v_select(is_asked, axis.slack, v_splat(INFINITY)), v_select(is_asked, v_sub(zero, axis.m_q), zero),
                         v_select(is_asked, v_sub(zero, axis.m_p), zero)};
}

/* The left side in row p, and in its cell q. */
TRIBOX_INLINE vnum side_in_row(const shadow_side *side, vnum p) { return v_fma(side->p_slope, p, side->at); }
TRIBOX_INLINE vnum side_in_cell(const shadow_side *side, vnum q, vnum in_row) { return v_fma(side->q_slope, q, in_row); }

/* Cells of a row from `first` to before `end`, once fractions are cut off: those that may overlap, and those that certainly do. */
typedef struct lane_run {
    vnum first_maybe, end_maybe, first_certain, end_certain;
} lane_run;

TRIBOX_INLINE lane_run whole_run(vnum cells)
{
    const vnum half = v_splat(0.5f), last = v_add(cells, half);
    return (lane_run){half, last, half, last};
}

/* What the limits leave of a run in row p. The run is the second operand, as that is what a NaN leaves. */
TRIBOX_INLINE void narrow(lane_run *run, const shadow_limits *limits, vnum p, bool is_exact)
{
    for (int j = 0; j < 2; j++) {
        const shadow_limit *const upper = &limits->upper[j], *const lower = &limits->lower[j];
        run->end_maybe = v_min(v_fma(upper->slope, p, upper->maybe), run->end_maybe);
        run->first_maybe = v_max(v_fma(lower->slope, p, lower->maybe), run->first_maybe);
        if (is_exact) {
            run->end_certain = v_min(v_fma(upper->slope, p, upper->certain), run->end_certain);
            run->first_certain = v_max(v_fma(lower->slope, p, lower->certain), run->first_certain);
        }
    }
}

/* The cells of both. */
TRIBOX_INLINE void narrow_to(lane_run *run, const lane_run *other, bool is_exact)
{
    run->end_maybe = v_min(run->end_maybe, other->end_maybe);
    run->first_maybe = v_max(run->first_maybe, other->first_maybe);
    if (is_exact) {
        run->end_certain = v_min(run->end_certain, other->end_certain);
        run->first_certain = v_max(run->first_certain, other->first_certain);
    }
}

/* The plane: an upper and a lower limit with the same slopes. */
typedef struct plane_limits {
    vnum end_maybe, first_maybe, end_certain, first_certain, j_slope, k_slope;
} plane_limits;

TRIBOX_INLINE plane_limits plane_of(const lane_places p[3], vnum bound_scale, vmask asked)
{
    const vnum zero = v_splat(0), one = v_splat(1), most = v_splat(INFINITY), least = v_splat(-INFINITY);
    const vnum normal[3] = {shadow_normal(&p[1], &p[2]), shadow_normal(&p[2], &p[0]), shadow_normal(&p[0], &p[1])};
    vnum n[3], S = zero, error = zero, low = zero, high = zero, d = zero;
    for (int i = 0; i < 3; i++) {
        S = v_fma(v_mul(p[(i + 1) % 3].F, p[(i + 2) % 3].F), p[i].R, S);
        n[i] = v_flip(normal[i], normal[0]); /* towards positive x */
        asked = m_and(asked, is_not_zero(p[i].F));
    }
    n[0] = v_max(n[0], v_div(v_mul(v_splat(32 * V_UNIT), S), p[0].R));
    for (int a = 0; a < 3; a++) {
        error = v_fma(v_abs(n[a]), p[a].E, error);
        low = v_add(low, v_min(n[a], zero));
        high = v_add(high, v_max(n[a], zero));
        d = v_fma(n[a], p[a].g[0], d);
    }
    const vnum per_n = v_div(one, n[0]);
    const vnum off = v_mul(v_fma(v_splat(256 * V_UNIT), S, v_mul(bound_scale, error)), per_n);
    const vnum upper = v_fma(v_sub(d, low), per_n, one), lower = v_fma(v_sub(d, high), per_n, one);
    return (plane_limits){v_select(asked, v_add(upper, off), most),
                          v_select(asked, v_sub(lower, off), least),
                          v_select(asked, v_sub(upper, off), most),
                          v_select(asked, v_add(lower, off), least),
                          v_select(asked, v_mul(v_sub(zero, n[1]), per_n), zero),
                          v_select(asked, v_mul(v_sub(zero, n[2]), per_n), zero)};
}

/* The cells that the plane leaves of a row: `along` is what its slopes come to there. */
TRIBOX_INLINE lane_run run_by_plane(const plane_limits *plane, vnum along)
{
    return (lane_run){v_add(along, plane->first_maybe), v_add(along, plane->end_maybe), v_add(along, plane->first_certain),
                      v_add(along, plane->end_certain)};
}
