/*
 * own_planes.h - rows limited by the very planes of their cells. After: rows.h. Needs: v_nearest_float.
 *
 * Limits take planes as evenly spaced, and where they are nearly as close as floats that leaves every fourth cell undecided. Here
 * the places of the planes that a limit is about are computed: those across the row, and the one plane along it that may lie on
 * either side of the limit, as planes are less than half a cell from their whole places (PROOFS.md 7.13).
 */

/* The number itself where it is whole, and the nearest one: of two that are as near, the even one. */
TRIBOX_INLINE vnum nearest_whole(vnum a)
{
    const vnum spacing_one = v_splat(0x1.8p52);
    return v_sub(v_add(a, spacing_one), spacing_one);
}

/* The place of plane n of axis a; both are counted from the triangle's first cell. */
TRIBOX_INLINE vnum plane_place(const strip_place *p, int a, vnum n)
{
    const tribox_voxels *const v = p->v;
    const double base = p->strip->base[a][p->t];
    const vnum number = v_add(n, v_splat(base + v->window.first[a]));
    const vnum plane = v_nearest_float(v_fma(number, v_splat(v->window.grid->cell[a]), v_splat(v->window.grid->origin[a])));
    const vnum place = v_mul(v_sub(plane, v_splat(v->window.lattice.origin[a])), v_splat(v->window.lattice.per_cell[a]));
    return v_sub(place, v_splat(base));
}

/* Of rows of cells, the places of their lower planes, and of their upper planes less one. */
typedef struct row_planes {
    vnum lower, upper;
} row_planes;

TRIBOX_INLINE row_planes planes_of_rows(const strip_place *p, int a, vnum n)
{
    const vnum one = v_splat(1);
    return (row_planes){plane_place(p, a, n), v_sub(plane_place(p, a, v_add(n, one)), one)};
}

/* The plane of a row that a limit is about: an upper one that rises from row to row is about the upper plane (limits.h). */
TRIBOX_INLINE vnum plane_for(const row_planes *row, vnum slope, bool is_upper)
{
    const vnum zero = v_splat(0);
    return v_select(is_upper ? v_gt(slope, zero) : v_gt(zero, slope), row->upper, row->lower);
}

/* What the limits of the shadow along i leave of rows, in places and not yet in cells. */
TRIBOX_INLINE void narrow_by_own(lane_run *run, const strip_limits *limits, unsigned t, int i, const row_planes *row)
{
    for (int e = 0; e < 2; e++) {
        const shadow_limit upper = splat_limit(&limits->upper[i][e], t), lower = splat_limit(&limits->lower[i][e], t);
        const vnum above = plane_for(row, upper.slope, true), below = plane_for(row, lower.slope, false);
        run->end_maybe = v_min(run->end_maybe, v_fma(upper.slope, above, upper.maybe));
        run->end_certain = v_min(run->end_certain, v_fma(upper.slope, above, upper.certain));
        run->first_maybe = v_max(run->first_maybe, v_fma(lower.slope, below, lower.maybe));
        run->first_certain = v_max(run->first_certain, v_fma(lower.slope, below, lower.certain));
    }
}

TRIBOX_INLINE void narrow_by_own_plane(lane_run *run, const strip_plane *plane, unsigned t, const row_planes *j,
                                       const row_planes *k)
{
    const vnum j_slope = v_splat(plane->j_slope[t]), k_slope = v_splat(plane->k_slope[t]);
    const vnum above = v_fma(j_slope, plane_for(j, j_slope, true), v_mul(k_slope, plane_for(k, k_slope, true)));
    const vnum below = v_fma(j_slope, plane_for(j, j_slope, false), v_mul(k_slope, plane_for(k, k_slope, false)));
    run->end_maybe = v_min(run->end_maybe, v_add(above, v_splat(plane->end_maybe[t])));
    run->end_certain = v_min(run->end_certain, v_add(above, v_splat(plane->end_certain[t])));
    run->first_maybe = v_max(run->first_maybe, v_add(below, v_splat(plane->first_maybe[t])));
    run->first_certain = v_max(run->first_certain, v_add(below, v_splat(plane->first_certain[t])));
}

TRIBOX_INLINE lane_run endless_run(void)
{
    const vnum most = v_splat(INFINITY), least = v_splat(-INFINITY);
    return (lane_run){least, most, least, most};
}

/* A place, not farther than two cells from the row of `cells`. */
TRIBOX_INLINE vnum near_row(vnum place, vnum cells) { return v_min(v_max(place, v_splat(-2)), v_add(cells, v_splat(2))); }

/* How many of the cells along axis a have their lower plane at the end or below: the plane next to the end is asked. */
TRIBOX_INLINE vnum cells_to(const strip_place *p, int a, vnum end, vnum cells)
{
    const vnum one = v_splat(1), at = near_row(v_sub(end, one), cells), n = nearest_whole(at);
    return v_min(v_select(v_gt(plane_place(p, a, n), at), n, v_add(n, one)), cells);
}

/* The first cell whose upper plane is at this place or above. */
TRIBOX_INLINE vnum cells_from(const strip_place *p, int a, vnum first, vnum cells)
{
    const vnum at = near_row(first, cells), n = nearest_whole(at);
    return v_max(v_select(v_gt(at, plane_place(p, a, n)), n, v_sub(n, v_splat(1))), v_splat(0));
}

/* From places to the cells along axis a. */
TRIBOX_INLINE lane_run cells_between(const strip_place *p, int a, const lane_run *run, vnum cells)
{
    return (lane_run){cells_from(p, a, run->first_maybe, cells), cells_to(p, a, run->end_maybe, cells),
                      cells_from(p, a, run->first_certain, cells), cells_to(p, a, run->end_certain, cells)};
}

/* What the shadow along x leaves of layers k: rows, of `cells` along y. */
TRIBOX_INLINE lane_run layers_by_own_planes(const strip_place *p, vnum cells, vnum k)
{
    const row_planes planes = planes_of_rows(p, 2, k);
    lane_run run = endless_run();
    narrow_by_own(&run, p->limits, p->t, 0, &planes);
    return cells_between(p, 1, &run, cells);
}

/* What the other limits leave of rows, of `cells` along x. */
TRIBOX_INLINE lane_run rows_by_own_planes(const strip_place *p, const strip_limits *limits, vnum cells, const row_planes *j,
                                          const row_planes *k, tribox_shape shape)
{
    lane_run run = endless_run();
    if (shape != TRIBOX_FLAT_Z)
        narrow_by_own(&run, limits, p->t, 1, k);
    if (shape != TRIBOX_FLAT_Y)
        narrow_by_own(&run, limits, p->t, 2, j);
    if (shape == TRIBOX_SOLID)
        narrow_by_own_plane(&run, &limits->plane, p->t, j, k);
    return cells_between(p, 0, &run, cells);
}

/* For limits as if planes were where they should be, but for the rounding of their places. */
TRIBOX_INLINE tribox_lattice lattice_by_own_planes(const tribox_voxels *v)
{
    tribox_lattice lattice = v->window.lattice;
    for (int a = 0; a < 3; a++)
        lattice.error[a] = 0x1p-50 * ((double)v->window.size[a] + 4);
    return lattice;
}
