/*
 * shadow.h - shadows of triangles on two axes of a grid, in float: rows of cells along axis q are limited, linearly in the row p.
 * After: axes.h, voxels.h. Needs: v_div.
 *
 * The limits are those of rows.h, triangle by lane, and so are the names. Axes q and p of a shadow are turned so that with
 * n = f_0q f_1p - f_0p f_1q, s its sign, m_q = s f_jp and m_p = -s f_jq, a cell overlaps only if, X its corner that is least along m,
 *   m_q (g_jq - X_q) + m_p (g_jp - X_p) >= 0
 *
 * Error bounds (PROOFS.md 7.6), with E_a = error_a + 2^-22 (base_a + R_a) for places and planes:
 *   W = F_p (E_q + 2^-17 R_q) + F_q (E_p + 2^-17 R_p)
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
    p.E = v_fma(v_add(base, p.R), v_splat(0x1p-22f), error);
    return p;
}

/* Those that float is too narrow for: longer than 2^20 cells, or with edges that are shorter than 2^-40 cells but not zero. */
TRIBOX_INLINE vmask is_wild(const lane_places *a)
{
    vmask wild = v_gt(a->F, v_splat(0x1p20f));
    for (int j = 0; j < 3; j++)
        wild = m_or(wild, m_andnot(v_gt(v_splat(0x1p-40f), v_abs(a->f[j])), v_is_zero(a->f[j])));
    return wild;
}

/* The cross product of the first two edges: a part of the normal. */
TRIBOX_INLINE vnum shadow_normal(const lane_places *q, const lane_places *p)
{
    return v_fms(q->f[0], p->f[1], v_mul(p->f[0], q->f[1]));
}

TRIBOX_INLINE vnum shadow_error(const lane_places *q, const lane_places *p)
{
    const vnum rounding = v_splat(0x1p-17f);
    return v_fma(p->F, v_fma(q->R, rounding, q->E), v_mul(q->F, v_fma(p->R, rounding, p->E)));
}

/* The axis of edge j: m, the left side for cell (0, 0), and the lanes where it is not redundant. */
typedef struct shadow_axis {
    vnum m_q, m_p, slack;
    vmask asked;
} shadow_axis;

/* m (g - X): X is the upper plane of cell 0 where m is negative. */
TRIBOX_INLINE vnum from_corner(vnum g, vnum m) { return v_fms(m, g, v_min(m, v_splat(0))); }

TRIBOX_INLINE shadow_axis shadow_axis_of(const lane_places *q, const lane_places *p, int j, vnum n)
{
    const vnum m_q = v_flip(p->f[j], n), m_p = v_flip(q->f[j], v_flip(n, v_splat(-0.0f)));
    return (shadow_axis){m_q, m_p, v_add(from_corner(q->g[j], m_q), from_corner(p->g[j], m_p)),
                         m_not(m_or(v_is_zero(m_q), v_is_zero(m_p)))};
}

/*
 * Limits on cells: one more than places, so that cutting off the fraction rounds up; infinite where there are none. Of the three edges
 * at most two are upper and at most two lower; one may fill both places (PROOFS.md 7.5).
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

TRIBOX_INLINE shadow_limits limits_of(const lane_places *q, const lane_places *p, vnum n, vnum error, vmask asked)
{
    const vnum zero = v_splat(0), most = v_splat(INFINITY), least = v_splat(-INFINITY);
    const shadow_limit no_upper = {zero, most, most}, no_lower = {zero, least, least};
    shadow_limit upper[3], lower[3];
    vmask is_upper[3], is_lower[3];
    for (int j = 0; j < 3; j++) {
        const shadow_axis axis = shadow_axis_of(q, p, j, n);
        const vnum per_m = v_div(v_splat(1), axis.m_q);
        const vnum at = v_fma(axis.slack, per_m, v_splat(1)), slope = v_mul(v_sub(zero, axis.m_p), per_m);
        const vnum off = v_mul(error, v_abs(per_m));
        const vmask is_asked = m_and(asked, axis.asked);
        upper[j] = (shadow_limit){slope, v_add(at, off), v_sub(at, off)};
        lower[j] = (shadow_limit){slope, v_sub(at, off), v_add(at, off)};
        is_upper[j] = m_and(is_asked, v_gt(axis.m_q, zero));
        is_lower[j] = m_and(is_asked, v_gt(zero, axis.m_q));
    }
    const shadow_limit third_upper = select_limit(is_upper[2], &upper[2], &no_upper);
    const shadow_limit third_lower = select_limit(is_lower[2], &lower[2], &no_lower);
    shadow_limits limits;
    for (int j = 0; j < 2; j++) {
        limits.upper[j] = select_limit(is_upper[j], &upper[j], &third_upper);
        limits.lower[j] = select_limit(is_lower[j], &lower[j], &third_lower);
    }
    return limits;
}

/* Cells of a row from `first` to before `end`, once their fractions are cut off: those that may overlap, and those that certainly do. */
typedef struct lane_run {
    vnum first_maybe, end_maybe, first_certain, end_certain;
} lane_run;

TRIBOX_INLINE lane_run whole_run(vnum cells)
{
    const vnum half = v_splat(0.5f), last = v_add(cells, half);
    return (lane_run){half, last, half, last};
}

/* What the limits leave of a run in row p. */
TRIBOX_INLINE void narrow(lane_run *run, const shadow_limits *limits, vnum p, bool is_exact)
{
    for (int j = 0; j < 2; j++) {
        const shadow_limit *const upper = &limits->upper[j], *const lower = &limits->lower[j];
        run->end_maybe = v_min(run->end_maybe, v_fma(upper->slope, p, upper->maybe));
        run->first_maybe = v_max(run->first_maybe, v_fma(lower->slope, p, lower->maybe));
        if (is_exact) {
            run->end_certain = v_min(run->end_certain, v_fma(upper->slope, p, upper->certain));
            run->first_certain = v_max(run->first_certain, v_fma(lower->slope, p, lower->certain));
        }
    }
}

/* Cells of a row, a bit each. */
typedef struct row_cells {
    vint maybe, certain;
} row_cells;

TRIBOX_INLINE vint run_bits(vnum first, vnum end)
{
    const vnum half = v_splat(0.5f);
    return i_andnot(i_ones_from(v_max(first, half)), i_ones_from(v_max(end, half)));
}

TRIBOX_INLINE row_cells cells_of(const lane_run *run, bool is_exact)
{
    row_cells cells;
    cells.maybe = run_bits(run->first_maybe, run->end_maybe);
    cells.certain = is_exact ? run_bits(run->first_certain, run->end_certain) : cells.maybe;
    return cells;
}

/* The cells that the limits leave of the first `cells` of row p. */
TRIBOX_INLINE row_cells cells_within(const shadow_limits *limits, vnum cells, vnum p, bool is_exact)
{
    lane_run run = whole_run(cells);
    narrow(&run, limits, p, is_exact);
    return cells_of(&run, is_exact);
}
