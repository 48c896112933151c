/*
 * rows.h - one triangle against rows of grid cells, in double: every axis leaves an interval of a row, and so do all.
 *
 * In places (cells.h) a cell is a unit cube, plane p of an axis lies at p and vertex j at g_j; f_j and n are made from these. The
 * axis a_ij says that a box overlaps only if, with m = s_i (f_jb, -f_ja) and X the corner of the box that is least along m,
 *   m_a (g_ja - X_a) + m_b (g_jb - X_b) >= 0
 * which is the slack of axes.h, halved. X is a cell's index, or that and one: the left side is linear in the cell. Along x it is a
 * limit on i; in the projection along x it is a side, which takes or leaves whole rows. The plane limits i from both ends:
 *   n . (g_0 - X) >= 0 >= n . (g_0 - Y)       X the corner of least n . x, Y the opposite one
 *
 * Error bounds. With F_a the extent of the triangle in cells and R_a = F_a + cells + 2, which no |g - X| exceeds, a place is off by
 * at most E_a = 2 error_a + 2^-49 F_a together with the plane it is compared with. So a side of a_ij is off by at most
 *   |m_a| E_a + |m_b| E_b + W_i    W_i = 2^-44 (F_a R_b + F_b R_a)
 * where W_i covers, at u = 2^-53, the roundings of these lines (below 16 u), and what the certificate of overlap asks where rounding
 * turned the sign of n_i (bounds.h: 9 times the 8 u of f and n). The plane is off by at most
 *   sum of |n_a| E_a + 2^-43 S     S = sum of F_a F_b R_i
 * Divided by |m_x| or |n_x| these bound a limit. An n_x below 2^-46 S / R_x is taken for that, which moves the plane by 2^-46 S.
 *
 * Redundant axes are left out as in settle.h: they are the ties of scenes that lie in the grid's own planes.
 */
typedef struct row_triangle {
    vnum f[3][3], g[3][3]; /* edges and vertices, [j][a] */
    vnum n[3];
    vnum F[3], R[3], E[3];
} row_triangle;

TRIBOX_INLINE void place_axis(row_triangle *t, const tribox_strip *strip, unsigned at, const tribox_lattice *lattice, int a)
{
    const vnum origin = v_splat(lattice->origin[a]), per_cell = v_splat(lattice->per_cell[a]);
    vnum u[3];
    for (int j = 0; j < 3; j++)
        u[j] = v_load(&strip->u[3 * j + a][at]);
    for (int j = 0; j < 3; j++) {
        t->f[j][a] = v_mul(v_sub(u[(j + 1) % 3], u[j]), per_cell);
        t->g[j][a] = v_sub(v_mul(v_sub(u[j], origin), per_cell), v_read(&strip->base[a][at]));
    }
    t->F[a] = lane_max3(v_abs(t->f[0][a]), v_abs(t->f[1][a]), v_abs(t->f[2][a]));
    t->R[a] = v_add(v_add(t->F[a], v_read(&strip->cells[a][at])), v_splat(2));
    t->E[a] = v_fma(t->F[a], v_splat(0x1p-49), v_splat(2 * lattice->error[a]));
}

TRIBOX_INLINE vmask is_not_zero(vnum a) { return v_gt(v_abs(a), v_splat(0)); }

/* g - X: X is the upper plane of cell 0 where m is negative. */
TRIBOX_INLINE vnum from_corner(vnum g, vnum m) { return v_sub(g, v_select(v_gt(m, v_splat(0)), v_splat(0), v_splat(1))); }

/* The axis a_ij for cell (0, 0, 0): offset, slopes, error; which lanes are asked. */
typedef struct row_axis {
    vnum offset, m_a, m_b, error;
    vmask asked;
} row_axis;

TRIBOX_INLINE row_axis axis_of(const row_triangle *t, int i, int j, vnum margin)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const vnum s = v_sign(t->n[i]), W = v_mul(v_splat(0x1p-44), v_fma(t->F[a], t->R[b], v_mul(t->F[b], t->R[a])));
    row_axis axis;
    axis.m_a = v_flip(t->f[j][b], s);
    axis.m_b = v_flip(v_flip(t->f[j][a], s), v_splat(-0.0));
    axis.offset = v_fma(axis.m_a, from_corner(t->g[j][a], axis.m_a), v_mul(axis.m_b, from_corner(t->g[j][b], axis.m_b)));
    axis.error = v_mul(margin, v_fma(v_abs(axis.m_a), t->E[a], v_fma(v_abs(axis.m_b), t->E[b], W)));
    axis.asked = m_and(is_not_zero(t->f[j][a]), is_not_zero(t->f[j][b]));
    return axis;
}

TRIBOX_INLINE void write_side(tribox_side *side, unsigned at, const row_axis *axis)
{
    const vnum zero = v_splat(0);
    v_write(&side->offset[at], v_select(axis->asked, axis->offset, v_splat(INFINITY)));
    v_write(&side->j_slope[at], v_select(axis->asked, axis->m_a, zero));
    v_write(&side->k_slope[at], v_select(axis->asked, axis->m_b, zero));
    v_write(&side->error[at], v_select(axis->asked, axis->error, zero));
}

/* A limit on i in lanes; where there is none it is infinite. */
typedef struct row_limit {
    vnum maybe, sure, slope;
} row_limit;

TRIBOX_INLINE row_limit select_limit(vmask m, const row_limit *a, const row_limit *b)
{
    return (row_limit){v_select(m, a->maybe, b->maybe), v_select(m, a->sure, b->sure), v_select(m, a->slope, b->slope)};
}

TRIBOX_INLINE void write_limit(tribox_limit *limit, unsigned at, const row_limit *from)
{
    v_write(&limit->maybe[at], from->maybe);
    v_write(&limit->sure[at], from->sure);
    v_write(&limit->slope[at], from->slope);
}

/*
 * The three edges of the projection along i, 1 or 2: of their three limits at most two are upper and at most two lower, as the f_jb
 * sum up to zero. A limit may fill both places.
 */
TRIBOX_INLINE void write_limits(tribox_limit upper[2], tribox_limit lower[2], unsigned at, const row_triangle *t, int i,
                                vnum margin)
{
    const row_limit no_upper = {v_splat(INFINITY), v_splat(INFINITY), v_splat(0)};
    const row_limit no_lower = {v_splat(-INFINITY), v_splat(-INFINITY), v_splat(0)};
    row_limit up[3], low[3];
    vmask is_up[3], is_low[3];
    for (int j = 0; j < 3; j++) {
        const row_axis axis = axis_of(t, i, j, margin);
        const vnum m_x = i == 1 ? axis.m_b : axis.m_a, m_other = i == 1 ? axis.m_a : axis.m_b;
        const vnum per_m = v_div(v_splat(1), m_x);
        const vnum limit = v_mul(axis.offset, per_m), error = v_mul(axis.error, v_abs(per_m)), slope = v_mul(m_other, per_m);
        is_up[j] = m_and(axis.asked, v_gt(m_x, v_splat(0)));
        is_low[j] = m_and(axis.asked, v_gt(v_splat(0), m_x));
        up[j] = (row_limit){v_add(limit, error), v_sub(limit, error), slope};
        low[j] = (row_limit){v_sub(limit, error), v_add(limit, error), slope};
    }
    const row_limit third_up = select_limit(is_up[2], &up[2], &no_upper), third_low = select_limit(is_low[2], &low[2], &no_lower);
    for (int j = 0; j < 2; j++) {
        const row_limit one_up = select_limit(is_up[j], &up[j], &third_up), one_low = select_limit(is_low[j], &low[j], &third_low);
        write_limit(&upper[j], at, &one_up);
        write_limit(&lower[j], at, &one_low);
    }
}

TRIBOX_INLINE void write_plane(tribox_slab *slab, unsigned at, const row_triangle *t, vnum margin)
{
    const vnum zero = v_splat(0), one = v_splat(1);
    vnum n[3], S = zero, error = zero, least = zero, most = zero, d = zero;
    vmask asked = v_gt(one, zero);
    for (int i = 0; i < 3; i++)
        S = v_fma(v_mul(t->F[(i + 1) % 3], t->F[(i + 2) % 3]), t->R[i], S);
    for (int a = 0; a < 3; a++) {
        n[a] = v_flip(t->n[a], v_sign(t->n[0])); /* towards positive x */
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
    error = v_mul(v_mul(margin, v_fma(v_splat(0x1p-43), S, error)), per_n);
    const vnum upper = v_mul(v_sub(d, least), per_n), lower = v_mul(v_sub(d, most), per_n);
    v_write(&slab->upper_maybe[at], v_select(asked, v_add(upper, error), v_splat(INFINITY)));
    v_write(&slab->upper_sure[at], v_select(asked, v_sub(upper, error), v_splat(INFINITY)));
    v_write(&slab->lower_maybe[at], v_select(asked, v_sub(lower, error), v_splat(-INFINITY)));
    v_write(&slab->lower_sure[at], v_select(asked, v_add(lower, error), v_splat(-INFINITY)));
    v_write(&slab->j_slope[at], v_select(asked, v_mul(n[1], per_n), zero));
    v_write(&slab->k_slope[at], v_select(asked, v_mul(n[2], per_n), zero));
}

static void prepare_strip(tribox_strip *strip, const tribox_lattice *lattice, unsigned axes, double margin)
{
    for (unsigned at = 0; at < strip->count; at += V_LANES) {
        row_triangle t;
        for (int a = 0; a < 3; a++)
            place_axis(&t, strip, at, lattice, a);
        for (int i = 0; i < 3; i++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            t.n[i] = v_fms(t.f[0][a], t.f[1][b], v_mul(t.f[0][b], t.f[1][a]));
        }
        row_triangle edges = t, plane = t; /* a triangle without extent limits nothing */
        for (int a = 0; a < 3; a++) {
            if (!(axes & TRIBOX_AXES_EDGES))
                edges.f[0][a] = edges.f[1][a] = edges.f[2][a] = v_splat(0);
            if (!(axes & TRIBOX_AXES_PLANE))
                plane.F[a] = v_splat(0);
        }
        for (int j = 0; j < 3; j++) {
            const row_axis axis = axis_of(&edges, 0, j, v_splat(margin));
            write_side(&strip->side[j], at, &axis);
        }
        for (int i = 1; i < 3; i++)
            write_limits(strip->upper[i - 1], strip->lower[i - 1], at, &edges, i, v_splat(margin));
        write_plane(&strip->plane, at, &plane, v_splat(margin));
    }
}

/* Where a row's limits stand so far. */
typedef struct row_ends {
    vnum side, upper, lower;
} row_ends;

/* i <= upper to the last cell, -1 at least; i >= lower to the first. Halves and quarters keep the clamps clear of ties. */
TRIBOX_INLINE void write_ends(double *first, double *last, const row_ends *ends, vnum cells)
{
    const vnum half = v_splat(0.5), none = v_splat(-0.75);
    const vnum upper = v_min(v_max(ends->upper, none), v_sub(cells, half));
    const vnum lower = v_min(v_max(ends->lower, v_sub(none, v_splat(-0.25))), v_sub(cells, v_splat(0.25)));
    v_write(last, rounded(v_sub(v_select(v_gt(v_splat(0), ends->side), none, upper), half)));
    v_write(first, rounded(v_add(lower, half)));
}

TRIBOX_INLINE void limit_rows(const tribox_strip *strip, unsigned t, double row, unsigned rows, tribox_row_cells *out,
                              bool is_sure_asked)
{
    static const float count[64] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                    22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43,
                                    44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63};
    const vnum wide = v_splat(strip->cells[1][t]), per_wide = v_splat(1 / strip->cells[1][t]), cells = v_splat(strip->cells[0][t]);
    for (unsigned at = 0; at < rows; at += V_LANES) {
        const vnum r = v_add(v_splat(row), v_load(&count[at])), half = v_splat(0.5);
        const vnum k = rounded(v_fms(v_add(r, half), per_wide, half)), j = v_sub(r, v_mul(k, wide));
        row_ends maybe = {v_splat(INFINITY), v_splat(INFINITY), v_splat(-INFINITY)}, sure = maybe;
        for (int e = 0; e < 3; e++) {
            const tribox_side *const side = &strip->side[e];
            const vnum error = v_splat(side->error[t]);
            const vnum slack =
                v_sub(v_sub(v_splat(side->offset[t]), v_mul(v_splat(side->j_slope[t]), j)), v_mul(v_splat(side->k_slope[t]), k));
            maybe.side = v_min(maybe.side, v_add(slack, error));
            sure.side = v_min(sure.side, v_sub(slack, error));
        }
        for (int e = 0; e < 4; e++) {
            const tribox_limit *const upper = &strip->upper[e / 2][e % 2], *const lower = &strip->lower[e / 2][e % 2];
            const vnum up = v_mul(v_splat(upper->slope[t]), e < 2 ? k : j), low = v_mul(v_splat(lower->slope[t]), e < 2 ? k : j);
            maybe.upper = v_min(maybe.upper, v_sub(v_splat(upper->maybe[t]), up));
            maybe.lower = v_max(maybe.lower, v_sub(v_splat(lower->maybe[t]), low));
            sure.upper = v_min(sure.upper, v_sub(v_splat(upper->sure[t]), up));
            sure.lower = v_max(sure.lower, v_sub(v_splat(lower->sure[t]), low));
        }
        const tribox_slab *const plane = &strip->plane;
        const vnum along = v_fma(v_splat(plane->j_slope[t]), j, v_mul(v_splat(plane->k_slope[t]), k));
        maybe.upper = v_min(maybe.upper, v_sub(v_splat(plane->upper_maybe[t]), along));
        maybe.lower = v_max(maybe.lower, v_sub(v_splat(plane->lower_maybe[t]), along));
        sure.upper = v_min(sure.upper, v_sub(v_splat(plane->upper_sure[t]), along));
        sure.lower = v_max(sure.lower, v_sub(v_splat(plane->lower_sure[t]), along));
        write_ends(&out->first_maybe[at], &out->last_maybe[at], &maybe, cells);
        if (is_sure_asked)
            write_ends(&out->first_sure[at], &out->last_sure[at], &sure, cells);
    }
}

static void rows_both(const tribox_strip *strip, unsigned t, double row, unsigned rows, tribox_row_cells *out)
{
    limit_rows(strip, t, row, rows, out, true);
}

static void rows_maybe(const tribox_strip *strip, unsigned t, double row, unsigned rows, tribox_row_cells *out)
{
    limit_rows(strip, t, row, rows, out, false);
}

#define GRID_SYMBOL_(name) tribox_grid_##name
#define GRID_SYMBOL(name) GRID_SYMBOL_(name)

extern const tribox_grid_kernel GRID_SYMBOL(KERNEL);
const tribox_grid_kernel GRID_SYMBOL(KERNEL) = {
    .reach = reach_word,
    .prepare = prepare_strip,
    .rows = rows_both,
    .rows_maybe = rows_maybe,
};
