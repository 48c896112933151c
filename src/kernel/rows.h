/*
 * rows.h - one triangle against rows of grid cells, in double: each axis leaves an interval of the row.
 * After: axes.h. Needs: v_div, v_read, v_write_int.
 *
 * In places (kernel_grid.h) a cell is a unit cube, plane p of an axis lies at p and vertex j at g_j; f_j and n are made from these,
 * and s_i is the sign of n_i. The axis a_ij says that a cell overlaps only if, with m_a = s_i f_jb, m_b = -s_i f_ja and X the
 * corner of the cell that is least along m,
 *   m_a (g_ja - X_a) + m_b (g_jb - X_b) >= 0
 * which is half the slack of axes.h (PROOFS.md 7.5). X is a cell's index, or that plus one: the left side is linear in the cell.
 * Along x it is a limit on i; in the projection along x it is a side, which takes or leaves whole rows. The plane limits i from
 * both ends:
 *   n . (g_0 - X) >= 0 >= n . (g_0 - Y)       X the corner of least n . x, Y the opposite one
 *
 * Error bounds (PROOFS.md 7.2, 7.6). With F_a the extent of the triangle in cells and R_a = F_a + cells + 2, |g - X| <= 3 R_a
 * (<= R_a unless planes are nearly as close as floats). A place and the plane that it is compared with are off by at most
 * E_a = error_a + 2^-49 F_a together, and the left side of every a_ij by
 *   W_i = F_b (E_a + 2^-44 R_a) + F_a (E_b + 2^-44 R_b)
 * where 2^-44, 512 u at u = 2^-53, covers the roundings of these lines and a sign of n_i that they turn. The plane is off by at
 * most
 *   sum of |n_a| E_a + 2^-43 S     S = sum of F_a F_b R_i
 * Divided by |m_x| or |n_x| these bound a limit. Where n_x is below 2^-46 S / R_x, that is used in its place, which moves the plane
 * by at most 3 * 2^-46 S (PROOFS.md 7.7). FAST keeps 2^-43 S: without it a segment, whose n is zero, would be lost.
 *
 * Redundant axes are left out (PROOFS.md 2): they are the ties of scenes that lie in the grid's own planes.
 */

/* To the nearest integer, for places in a grid: below 2^51. */
TRIBOX_INLINE vnum rounded(vnum a)
{
    const vnum shift = v_splat(0x1.8p52);
    return v_sub(v_add(a, shift), shift);
}

typedef struct row_triangle {
    vnum f[3][3], g[3][3]; /* edges and vertices, [j][a] */
    vnum n[3];
    vnum F[3], R[3], E[3];
} row_triangle;

TRIBOX_INLINE void place_axis(row_triangle *t, const tribox_strip *strip, unsigned at, const tribox_lattice *lattice, int a)
{
    const vnum origin = v_splat(lattice->origin[a]), per_cell = v_splat(lattice->per_cell[a]);
    const vnum base = v_read(&strip->base[a][at]);
    vnum u[3];
    for (int j = 0; j < 3; j++)
        u[j] = v_load(&strip->u[3 * a + j][at]);
    for (int j = 0; j < 3; j++) {
        t->f[j][a] = v_mul(v_sub(u[(j + 1) % 3], u[j]), per_cell);
        t->g[j][a] = v_sub(v_mul(v_sub(u[j], origin), per_cell), base);
    }
    t->F[a] = lane_max3(v_abs(t->f[0][a]), v_abs(t->f[1][a]), v_abs(t->f[2][a]));
    t->R[a] = v_add(v_add(t->F[a], v_read(&strip->cells[a][at])), v_splat(2));
    t->E[a] = v_fma(t->F[a], v_splat(0x1p-49), v_splat(lattice->error[a]));
}

TRIBOX_INLINE void place_normal(row_triangle *t, int i)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    t->n[i] = v_fms(t->f[0][a], t->f[1][b], v_mul(t->f[0][b], t->f[1][a]));
}

TRIBOX_INLINE vmask is_not_zero(vnum a) { return v_gt(v_abs(a), v_splat(0)); }

/* W_i (PROOFS.md 7.6). */
TRIBOX_INLINE vnum edges_error(const row_triangle *t, int i)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const vnum rounding = v_splat(0x1p-44);
    return v_fma(t->F[b], v_fma(t->R[a], rounding, t->E[a]), v_mul(t->F[a], v_fma(t->R[b], rounding, t->E[b])));
}

/* The axis a_ij: m, the left side for cell (0, 0, 0), and the lanes where it is not redundant. */
typedef struct row_axis {
    vnum m_a, m_b, slack;
    vmask asked;
} row_axis;

/* m (g - X): X is the upper plane of cell 0 where m is negative. */
TRIBOX_INLINE vnum from_corner(vnum g, vnum m) { return v_sub(v_mul(m, g), v_min(m, v_splat(0))); }

TRIBOX_INLINE row_axis axis_of(const row_triangle *t, int i, int j)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const vnum m_a = v_flip(t->f[j][b], t->n[i]), m_b = v_flip(t->f[j][a], v_flip(t->n[i], v_splat(-0.0)));
    return (row_axis){m_a, m_b, v_add(from_corner(t->g[j][a], m_a), from_corner(t->g[j][b], m_b)),
                      m_and(is_not_zero(m_a), is_not_zero(m_b))};
}

TRIBOX_INLINE void write_sides(tribox_limits *limits, unsigned at, const row_triangle *t, vnum bound_scale)
{
    const vnum zero = v_splat(0), error = v_mul(bound_scale, edges_error(t, 0));
    for (int j = 0; j < 3; j++) {
        const row_axis axis = axis_of(t, 0, j);
        v_write(&limits->side[j].at[at], v_select(axis.asked, axis.slack, v_splat(INFINITY)));
        v_write(&limits->side[j].j_slope[at], v_select(axis.asked, v_sub(zero, axis.m_a), zero));
        v_write(&limits->side[j].k_slope[at], v_select(axis.asked, v_sub(zero, axis.m_b), zero));
        v_write(&limits->side[j].error[at], error);
    }
}

/* A limit in lanes, one more than the place that it stands for; infinite where there is none. */
typedef struct row_limit {
    vnum at, slope, error;
} row_limit;

TRIBOX_INLINE row_limit select_limit(vmask m, const row_limit *a, const row_limit *b)
{
    return (row_limit){v_select(m, a->at, b->at), v_select(m, a->slope, b->slope), v_select(m, a->error, b->error)};
}

TRIBOX_INLINE void write_limit(tribox_limit *limit, unsigned at, const row_limit *from)
{
    v_write(&limit->at[at], from->at);
    v_write(&limit->slope[at], from->slope);
    v_write(&limit->error[at], from->error);
}

/*
 * The three edges of the projection along i, 1 or 2: at most two of their limits are upper and at most two lower, as the m_x sum to
 * zero (PROOFS.md 7.5). One limit may fill both places. Returns the largest error.
 */
TRIBOX_INLINE vnum write_limits(tribox_limits *limits, unsigned at, const row_triangle *t, int i, vnum bound_scale)
{
    const vnum zero = v_splat(0), error = v_mul(bound_scale, edges_error(t, i));
    const row_limit no_upper = {v_splat(INFINITY), zero, zero}, no_lower = {v_splat(-INFINITY), zero, zero};
    row_limit limit[3];
    vmask is_upper[3], is_lower[3];
    vnum largest = zero;
    for (int j = 0; j < 3; j++) {
        const row_axis axis = axis_of(t, i, j);
        const vnum m_x = i == 1 ? axis.m_b : axis.m_a, m_other = i == 1 ? axis.m_a : axis.m_b;
        const vnum per_m = v_div(v_splat(1), m_x);
        limit[j] =
            (row_limit){v_fma(axis.slack, per_m, v_splat(1)), v_mul(v_sub(zero, m_other), per_m), v_mul(error, v_abs(per_m))};
        is_upper[j] = m_and(axis.asked, v_gt(m_x, zero));
        is_lower[j] = m_and(axis.asked, v_gt(zero, m_x));
        largest = v_max(largest, v_select(axis.asked, limit[j].error, zero));
    }
    const row_limit third_upper = select_limit(is_upper[2], &limit[2], &no_upper);
    const row_limit third_lower = select_limit(is_lower[2], &limit[2], &no_lower);
    for (int j = 0; j < 2; j++) {
        const row_limit upper = select_limit(is_upper[j], &limit[j], &third_upper);
        const row_limit lower = select_limit(is_lower[j], &limit[j], &third_lower);
        write_limit(&limits->upper[i - 1][j], at, &upper);
        write_limit(&limits->lower[i - 1][j], at, &lower);
    }
    return largest;
}

/* Returns the error of its limits. */
TRIBOX_INLINE vnum write_plane(tribox_limits *limits, unsigned at, const row_triangle *t, vnum bound_scale)
{
    const vnum zero = v_splat(0), one = v_splat(1);
    vnum n[3], S = zero, error = zero, least = zero, most = zero, d = zero;
    vmask asked = m_all();
    for (int i = 0; i < 3; i++)
        S = v_fma(v_mul(t->F[(i + 1) % 3], t->F[(i + 2) % 3]), t->R[i], S);
    for (int a = 0; a < 3; a++) {
        n[a] = v_flip(t->n[a], t->n[0]); /* towards positive x */
        asked = m_and(asked, is_not_zero(t->F[a]));
    }
    n[0] = v_max(n[0], v_div(v_mul(v_splat(0x1p-46), S), t->R[0]));
    for (int a = 0; a < 3; a++) {
        error = v_fma(v_abs(n[a]), t->E[a], error);
        least = v_add(least, v_min(n[a], zero));
        most = v_add(most, v_max(n[a], zero));
        d = v_fma(n[a], t->g[0][a], d);
    }
    const vnum per_n = v_div(one, n[0]);
    error = v_select(asked, v_mul(v_fma(v_splat(0x1p-43), S, v_mul(bound_scale, error)), per_n), zero);
    v_write(&limits->plane.upper[at], v_select(asked, v_fma(v_sub(d, least), per_n, one), v_splat(INFINITY)));
    v_write(&limits->plane.lower[at], v_select(asked, v_fma(v_sub(d, most), per_n, one), v_splat(-INFINITY)));
    v_write(&limits->plane.j_slope[at], v_select(asked, v_mul(v_sub(zero, n[1]), per_n), zero));
    v_write(&limits->plane.k_slope[at], v_select(asked, v_mul(v_sub(zero, n[2]), per_n), zero));
    v_write(&limits->plane.error[at], error);
    return error;
}

/* A triangle without extent limits nothing. */
TRIBOX_INLINE row_triangle without_extent(const row_triangle *t)
{
    row_triangle point = *t;
    for (int a = 0; a < 3; a++)
        point.f[0][a] = point.f[1][a] = point.f[2][a] = point.F[a] = v_splat(0);
    return point;
}

TRIBOX_INLINE void prepare(const tribox_strip *strip, const tribox_lattice *lattice, unsigned axes, double bound_scale,
                           tribox_limits *limits, tribox_shape shape)
{
    for (unsigned at = 0; at < strip->count; at += V_LANES) {
        row_triangle t;
        vnum error = v_splat(0);
        for (int a = 0; a < 3; a++)
            place_axis(&t, strip, at, lattice, a);
        for (int i = 0; i < 3; i++)
            place_normal(&t, i);
        const row_triangle edges = axes & TRIBOX_AXES_EDGES ? t : without_extent(&t);
        const row_triangle plane = axes & TRIBOX_AXES_PLANE ? t : without_extent(&t);
        if (shape == TRIBOX_SOLID || shape == TRIBOX_FLAT_X)
            write_sides(limits, at, &edges, v_splat(bound_scale));
        if (shape == TRIBOX_SOLID || shape == TRIBOX_FLAT_Y)
            error = v_max(error, write_limits(limits, at, &edges, 1, v_splat(bound_scale)));
        if (shape == TRIBOX_SOLID || shape == TRIBOX_FLAT_Z)
            error = v_max(error, write_limits(limits, at, &edges, 2, v_splat(bound_scale)));
        if (shape == TRIBOX_SOLID)
            error = v_max(error, write_plane(limits, at, &plane, v_splat(bound_scale)));
        v_write(&limits->error[at], error);
        for (int a = 0; a < 2; a++)
            v_write(&limits->cells[a][at], v_read(&strip->cells[a][at]));
    }
}

/* The limits of rows in lanes: of the cells that may overlap, or of those that certainly do. */
typedef struct row_ends {
    vnum side, upper, lower;
} row_ends;

/*
 * Whole cells. A limit is one more than a place, so that cutting off its fraction rounds up (PROOFS.md 7.5); clamped half a cell
 * clear of zero and of `cells`, both ends lie in the row whatever the limits.
 */
TRIBOX_INLINE void write_ends(int32_t *first, int32_t *end, const row_ends *ends, vnum cells)
{
    const vnum half = v_splat(0.5), last = v_add(cells, half);
    const vnum upper = v_select(v_gt(v_splat(0), ends->side), half, ends->upper);
    v_write_int(end, v_min(v_max(upper, half), last));
    v_write_int(first, v_min(v_max(ends->lower, half), last));
}

TRIBOX_INLINE void limit(row_ends *ends, vnum upper, vnum lower)
{
    ends->upper = v_min(ends->upper, upper);
    ends->lower = v_max(ends->lower, lower);
}

/* Limits with errors of their own, or without where one common error follows. */
TRIBOX_INLINE void limit_both(row_ends *maybe, row_ends *certain, vnum upper, vnum lower, vnum upper_error, vnum lower_error,
                              bool is_error_common)
{
    if (is_error_common) {
        limit(maybe, upper, lower);
    } else {
        limit(maybe, v_add(upper, upper_error), v_sub(lower, lower_error));
        limit(certain, v_sub(upper, upper_error), v_add(lower, lower_error));
    }
}

TRIBOX_INLINE void limit_rows(const tribox_limits *limits, unsigned t, double row, unsigned rows, tribox_row_cells *out,
                              tribox_shape shape, bool is_error_common)
{
    static const float count[64] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                    22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43,
                                    44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63};
    const vnum wide = v_splat(limits->cells[1][t]), per_wide = v_splat(1 / limits->cells[1][t]),
               cells = v_splat(limits->cells[0][t]);
    for (unsigned at = 0; at < rows; at += V_LANES) {
        const vnum r = v_add(v_splat(row), v_load(&count[at])), half = v_splat(0.5);
        const vnum k = rounded(v_fms(v_add(r, half), per_wide, half)), j = v_sub(r, v_mul(k, wide));
        row_ends maybe = {v_splat(INFINITY), v_splat(INFINITY), v_splat(-INFINITY)}, certain = maybe;
        if (shape == TRIBOX_SOLID || shape == TRIBOX_FLAT_X) {
            vnum slack = v_splat(INFINITY);
            for (int e = 0; e < 3; e++)
                slack = v_min(slack, v_fma(v_splat(limits->side[e].j_slope[t]), j,
                                           v_fma(v_splat(limits->side[e].k_slope[t]), k, v_splat(limits->side[e].at[t]))));
            maybe.side = v_add(slack, v_splat(limits->side[0].error[t]));
            certain.side = v_sub(slack, v_splat(limits->side[0].error[t]));
        }
        for (int e = 0; e < 4; e++) {
            const tribox_limit *const upper = &limits->upper[e / 2][e % 2], *const lower = &limits->lower[e / 2][e % 2];
            const vnum p = e < 2 ? k : j;
            if (shape == TRIBOX_SOLID || shape == (e < 2 ? TRIBOX_FLAT_Y : TRIBOX_FLAT_Z))
                limit_both(&maybe, &certain, v_fma(v_splat(upper->slope[t]), p, v_splat(upper->at[t])),
                           v_fma(v_splat(lower->slope[t]), p, v_splat(lower->at[t])), v_splat(upper->error[t]),
                           v_splat(lower->error[t]), is_error_common);
        }
        if (shape == TRIBOX_SOLID) {
            const tribox_slab *const plane = &limits->plane;
            const vnum along = v_fma(v_splat(plane->j_slope[t]), j, v_mul(v_splat(plane->k_slope[t]), k));
            const vnum error = v_splat(plane->error[t]);
            limit_both(&maybe, &certain, v_add(along, v_splat(plane->upper[t])), v_add(along, v_splat(plane->lower[t])), error,
                       error, is_error_common);
        }
        if (is_error_common) {
            const vnum error = v_splat(limits->error[t]);
            certain.upper = v_sub(maybe.upper, error);
            certain.lower = v_add(maybe.lower, error);
            maybe.upper = v_add(maybe.upper, error);
            maybe.lower = v_sub(maybe.lower, error);
        }
        write_ends(&out->first_maybe[at], &out->end_maybe[at], &maybe, cells);
        write_ends(&out->first_certain[at], &out->end_certain[at], &certain, cells);
    }
}

/* One error for all limits, the largest, costs fewer operations; that of an edge nearly parallel to x would open too many cells. */
TRIBOX_INLINE void walk_rows(const tribox_limits *limits, unsigned t, double row, unsigned rows, tribox_row_cells *out,
                             tribox_shape shape)
{
    if (limits->error[t] < 0x1p-8)
        limit_rows(limits, t, row, rows, out, shape, true);
    else
        limit_rows(limits, t, row, rows, out, shape, false);
}
