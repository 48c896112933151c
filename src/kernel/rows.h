/*
 * rows.h - the limits that each axis puts on the cells that one triangle overlaps, in double.
 * After: axes.h. Needs: v_div, v_read, v_write_int.
 *
 * In places (kernel_grid.h) a cell is a unit cube, plane p of an axis lies at p and vertex j at g_j; f_j and n are made from these,
 * and s_i is the sign of n_i. The axis a_ij says that a cell overlaps only if, with m_a = s_i f_jb, m_b = -s_i f_ja and X the
 * corner of the cell that is least along m,
 *   m_a (g_ja - X_a) + m_b (g_jb - X_b) >= 0
 * which is half the slack of axes.h (PROOFS.md 7.5). X is a cell's index, or that plus one: the left side is linear in the cell.
 * So the projections along y and z limit i in each row, and the one along x limits j in each layer, up to an error:
 *   an upper limit keeps the cells with i + 1 <= at + slope * (k or j), a lower limit those with i + 1 > at + slope * (k or j)
 * The plane limits i from both ends:
 *   n . (g_0 - X) >= 0 >= n . (g_0 - Y)       X the corner of least n . x, Y the opposite one
 *
 * Error bounds (PROOFS.md 7.2, 7.6). With F_a the extent of the triangle in cells and R_a = F_a + cells + 2, |g - X| <= 3 R_a
 * (<= R_a unless planes are nearly as close as floats). A place and the plane that it is compared with are off by at most
 * E_a = error_a + 2^-49 F_a together, and the left side of every a_ij by
 *   W_i = F_b (E_a + 2^-44 R_a) + F_a (E_b + 2^-44 R_b)
 * where 2^-44, 512 u at u = 2^-53, covers the roundings of these lines and a sign of n_i that they turn. The plane is off by at
 * most
 *   sum of |n_a| E_a + 2^-43 S     S = sum of F_a F_b R_i
 * Divided by |m_x| (by |m_y| for a limit on j) or |n_x| these bound a limit. Where n_x is below 2^-46 S / R_x, that is used in its
 * place, which moves the plane by at most 3 * 2^-46 S (PROOFS.md 7.7). FAST keeps 2^-43 S: without it a segment, whose n is zero,
 * would be lost.
 *
 * Redundant axes are left out (PROOFS.md 2): they are the ties of scenes that lie in the grid's own planes.
 */

/* A limit of each triangle of a strip, moved outwards by its error (maybe) and inwards (certain). */
typedef struct strip_limit {
    double maybe[TRIBOX_STRIP], certain[TRIBOX_STRIP], slope[TRIBOX_STRIP];
} strip_limit;

/* The plane: an upper and a lower limit with the same slopes. */
typedef struct strip_plane {
    double upper_maybe[TRIBOX_STRIP], upper_certain[TRIBOX_STRIP], lower_maybe[TRIBOX_STRIP], lower_certain[TRIBOX_STRIP];
    double j_slope[TRIBOX_STRIP], k_slope[TRIBOX_STRIP];
} strip_plane;

/* Those that a shape needs. [0]: of the projection along x, on j by k; [1]: along y, on i by k; [2]: along z, on i by j. */
typedef struct strip_limits {
    strip_limit upper[3][2], lower[3][2];
    strip_plane plane; /* on i by both */
} strip_limits;

/* Whether the projection along i limits a shape. */
TRIBOX_INLINE bool is_limited(tribox_shape shape, int i) { return shape == TRIBOX_SOLID || (int)shape == TRIBOX_FLAT_X + i; }

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

/* A limit in lanes, one more than the place that it stands for; infinite where there is none. */
typedef struct row_limit {
    vnum at, slope, error;
} row_limit;

TRIBOX_INLINE row_limit select_limit(vmask m, const row_limit *a, const row_limit *b)
{
    return (row_limit){v_select(m, a->at, b->at), v_select(m, a->slope, b->slope), v_select(m, a->error, b->error)};
}

TRIBOX_INLINE void write_upper(strip_limit *limit, unsigned at, const row_limit *from)
{
    v_write(&limit->maybe[at], v_add(from->at, from->error));
    v_write(&limit->certain[at], v_sub(from->at, from->error));
    v_write(&limit->slope[at], from->slope);
}

TRIBOX_INLINE void write_lower(strip_limit *limit, unsigned at, const row_limit *from)
{
    v_write(&limit->maybe[at], v_sub(from->at, from->error));
    v_write(&limit->certain[at], v_add(from->at, from->error));
    v_write(&limit->slope[at], from->slope);
}

/*
 * The three edges of the projection along i: at most two of their limits are upper and at most two lower, as the m of the axis that
 * they limit sum to zero (PROOFS.md 7.5). One limit may fill both places.
 */
TRIBOX_INLINE void write_limits(strip_limits *limits, unsigned at, const row_triangle *t, int i, vnum bound_scale)
{
    const vnum zero = v_splat(0), error = v_mul(bound_scale, edges_error(t, i));
    const row_limit no_upper = {v_splat(INFINITY), zero, zero}, no_lower = {v_splat(-INFINITY), zero, zero};
    row_limit limit[3];
    vmask is_upper[3], is_lower[3];
    for (int j = 0; j < 3; j++) {
        const row_axis axis = axis_of(t, i, j);
        const vnum m = i == 1 ? axis.m_b : axis.m_a, m_other = i == 1 ? axis.m_a : axis.m_b;
        const vnum per_m = v_div(v_splat(1), m);
        limit[j] =
            (row_limit){v_fma(axis.slack, per_m, v_splat(1)), v_mul(v_sub(zero, m_other), per_m), v_mul(error, v_abs(per_m))};
        is_upper[j] = m_and(axis.asked, v_gt(m, zero));
        is_lower[j] = m_and(axis.asked, v_gt(zero, m));
    }
    const row_limit third_upper = select_limit(is_upper[2], &limit[2], &no_upper);
    const row_limit third_lower = select_limit(is_lower[2], &limit[2], &no_lower);
    for (int j = 0; j < 2; j++) {
        const row_limit upper = select_limit(is_upper[j], &limit[j], &third_upper);
        const row_limit lower = select_limit(is_lower[j], &limit[j], &third_lower);
        write_upper(&limits->upper[i][j], at, &upper);
        write_lower(&limits->lower[i][j], at, &lower);
    }
}

TRIBOX_INLINE void write_plane(strip_plane *plane, unsigned at, const row_triangle *t, vnum bound_scale)
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
    error = v_mul(v_fma(v_splat(0x1p-43), S, v_mul(bound_scale, error)), per_n);
    const vnum upper = v_fma(v_sub(d, least), per_n, one), lower = v_fma(v_sub(d, most), per_n, one);
    v_write(&plane->upper_maybe[at], v_select(asked, v_add(upper, error), v_splat(INFINITY)));
    v_write(&plane->upper_certain[at], v_select(asked, v_sub(upper, error), v_splat(INFINITY)));
    v_write(&plane->lower_maybe[at], v_select(asked, v_sub(lower, error), v_splat(-INFINITY)));
    v_write(&plane->lower_certain[at], v_select(asked, v_add(lower, error), v_splat(-INFINITY)));
    v_write(&plane->j_slope[at], v_select(asked, v_mul(v_sub(zero, n[1]), per_n), zero));
    v_write(&plane->k_slope[at], v_select(asked, v_mul(v_sub(zero, n[2]), per_n), zero));
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
                           strip_limits *limits, tribox_shape shape)
{
    for (unsigned at = 0; at < strip->count; at += V_LANES) {
        row_triangle t;
        for (int a = 0; a < 3; a++)
            place_axis(&t, strip, at, lattice, a);
        for (int i = 0; i < 3; i++)
            place_normal(&t, i);
        const row_triangle edges = axes & TRIBOX_AXES_EDGES ? t : without_extent(&t);
        const row_triangle plane = axes & TRIBOX_AXES_PLANE ? t : without_extent(&t);
        for (int i = 0; i < 3; i++)
            if (is_limited(shape, i))
                write_limits(limits, at, &edges, i, v_splat(bound_scale));
        if (shape == TRIBOX_SOLID)
            write_plane(&limits->plane, at, &plane, v_splat(bound_scale));
    }
}

/* The limits of runs of cells in lanes: of the cells that may overlap, and of those that certainly do. */
typedef struct run_ends {
    vnum upper, lower;
} run_ends;

typedef struct run_limits {
    run_ends maybe, certain;
} run_limits;

TRIBOX_INLINE run_limits no_limits(void)
{
    const run_ends none = {v_splat(INFINITY), v_splat(-INFINITY)};
    return (run_limits){none, none};
}

TRIBOX_INLINE void narrow(run_ends *ends, vnum upper, vnum lower)
{
    ends->upper = v_min(ends->upper, upper);
    ends->lower = v_max(ends->lower, lower);
}

/* By triangle t's edges of the projection along i, at the places p of the axis that their limits are linear in. */
TRIBOX_INLINE void narrow_by_edges(run_limits *run, const strip_limits *limits, unsigned t, int i, vnum p)
{
    for (int e = 0; e < 2; e++) {
        const strip_limit *const upper = &limits->upper[i][e], *const lower = &limits->lower[i][e];
        const vnum upper_slope = v_splat(upper->slope[t]), lower_slope = v_splat(lower->slope[t]);
        narrow(&run->maybe, v_fma(upper_slope, p, v_splat(upper->maybe[t])), v_fma(lower_slope, p, v_splat(lower->maybe[t])));
        narrow(&run->certain, v_fma(upper_slope, p, v_splat(upper->certain[t])), v_fma(lower_slope, p, v_splat(lower->certain[t])));
    }
}

TRIBOX_INLINE void narrow_by_plane(run_limits *run, const strip_plane *plane, unsigned t, vnum j, vnum k)
{
    const vnum along = v_fma(v_splat(plane->j_slope[t]), j, v_mul(v_splat(plane->k_slope[t]), k));
    narrow(&run->maybe, v_add(along, v_splat(plane->upper_maybe[t])), v_add(along, v_splat(plane->lower_maybe[t])));
    narrow(&run->certain, v_add(along, v_splat(plane->upper_certain[t])), v_add(along, v_splat(plane->lower_certain[t])));
}

/*
 * Whole cells. A limit is one more than a place, so that cutting off its fraction rounds up (PROOFS.md 7.5); clamped half a cell
 * clear of zero and of `cells`, both ends lie in the run whatever the limits.
 */
TRIBOX_INLINE void write_ends(int32_t *first, int32_t *end, const run_ends *ends, vnum cells)
{
    const vnum half = v_splat(0.5), last = v_add(cells, half);
    v_write_int(end, v_min(v_max(ends->upper, half), last));
    v_write_int(first, v_min(v_max(ends->lower, half), last));
}
