/*
 * reach.h - which cells of a grid the bounding boxes of a packet of triangles touch, in float.
 * After: axes.h, voxelizing.h. Needs: v_nearest.
 *
 * A number lies in the cell that its place says, unless a whole place is within `doubt` of that; then the plane there decides
 * (PROOFS.md 7.3). Where triangles are of doubles, these are asked.
 */
typedef struct lane_reach {
    vnum u[9];              /* the triangles: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 */
    const int32_t *number;  /* theirs; NULL where they have none */
    vmask blurred;          /* doubles that floats cannot stand for (PROOFS.md 7.11) */
    vnum base[3], cells[3]; /* the first cell, and how many, within the grid */
    vmask spans[3];         /* those with more than one, even if some lie outside the grid */
    vmask inside;           /* those that touch the grid */
} lane_reach;

/* Lanes `from` to before `end`. */
TRIBOX_INLINE vmask lanes_between(unsigned from, unsigned end)
{
    static const float lane[TRIBOX_LANES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const vnum number = v_load(lane);
    return m_andnot(v_gt(v_splat((float)end), number), v_gt(v_splat((float)from), number));
}

/* The sum is finite only if every number is. */
TRIBOX_INLINE vmask is_finite(const vnum u[9])
{
    vnum sum = v_splat(0);
    for (int n = 0; n < 9; n++)
        sum = v_add(sum, u[n]);
    return v_gt(v_splat(INFINITY), v_abs(sum));
}

/* Cells of an axis, first to last: below 0 or from `size` on they lie outside the grid. */
typedef struct lane_cells {
    vnum first, last;
} lane_cells;

/* The plane that is nearest to a number, of a place less half a cell, which is -1 or more. */
TRIBOX_INLINE int64_t nearest_plane(float middle) { return (int64_t)(middle + 1); }

/* On one axis the least and the greatest number of triangles in float, and their places, less half a cell. */
typedef struct lane_ends {
    vnum least, most, from, to;
} lane_ends;

/*
 * The cells that these lanes touch, lane by lane: a plane that is in doubt is the one next to the place. Blurred are triangles of
 * doubles where that plane parts vertices that became one float, their least or greatest.
 */
static lane_cells ask_planes(const tribox_voxel_window *w, lane_reach *r, int a, uint64_t lanes, lane_cells guess, lane_ends ends)
{
    float first[V_LANES], last[V_LANES], from[V_LANES], to[V_LANES], least[V_LANES], most[V_LANES], of[3][V_LANES];
    float blurred[V_LANES] = {0};
    v_write(first, guess.first);
    v_write(last, guess.last);
    v_write(from, ends.from);
    v_write(to, ends.to);
    v_write(least, ends.least);
    v_write(most, ends.most);
    for (int j = 0; j < 3; j++)
        v_write(of[j], r->u[3 * a + j]);
    for (; lanes; lanes &= lanes - 1) {
        const unsigned n = tribox_lowest_bit(lanes);
        const int64_t low = nearest_plane(from[n]), high = nearest_plane(to[n]);
        const double low_plane = tribox_plane_at(&w->planes, a, low), high_plane = tribox_plane_at(&w->planes, a, high);
        bool is_above = true, is_below = true, is_one_above = false, is_one_below = false;
        double u[3];
        tribox_window_read_axis(w, r->number[n], a, u);
        for (int j = 0; j < 3; j++) {
            const bool above = u[j] > low_plane, below = u[j] < high_plane;
            is_above &= above;
            is_below &= below;
            is_one_above |= above & (of[j][n] <= least[n]);
            is_one_below |= below & (of[j][n] >= most[n]);
        }
        first[n] = (float)(is_above ? low : low - 1);
        last[n] = (float)(is_below ? high - 1 : high);
        blurred[n] = (is_one_above & !is_above) | (is_one_below & !is_below);
    }
    r->blurred = m_or(r->blurred, v_gt(v_load(blurred), v_splat(0)));
    return (lane_cells){v_load(first), v_load(last)};
}

/*
 * The same for planes of floats. Where a plane takes one operation it is asked in all lanes, as compilers make vectors of such
 * loops; lanes that are not in doubt keep their answer.
 */
static lane_cells ask_planes_of_floats(const tribox_voxel_window *w, int a, vmask in_doubt, lane_cells guess, lane_ends ends)
{
    const uint64_t lanes = m_bits(in_doubt);
    const vnum half = v_splat(0.5f), low = v_nearest(v_add(ends.from, half)), high = v_nearest(v_add(ends.to, half));
    const double origin = w->planes.origin[a], cell = w->planes.cell[a], before = w->planes.first[a];
    float first[V_LANES], last[V_LANES], least[V_LANES], most[V_LANES];
    v_write(first, low);
    v_write(last, high);
    v_write(least, ends.least);
    v_write(most, ends.most);
    for (int n = 0; n < V_LANES; n++) {
        if (!TRIBOX_HAS_FUSED_PLANES && !(lanes >> n & 1))
            continue;
        const double low_plane = tribox_plane_rounded(origin, cell, before + (double)first[n]);
        const double high_plane = tribox_plane_rounded(origin, cell, before + (double)last[n]);
        first[n] -= (double)least[n] > low_plane ? 0.0f : 1.0f;
        last[n] -= (double)most[n] < high_plane ? 1.0f : 0.0f;
    }
    return (lane_cells){v_select(in_doubt, v_load(first), guess.first), v_select(in_doubt, v_load(last), guess.last)};
}

TRIBOX_INLINE vnum plus_where(vnum a, vmask more, vmask less)
{
    const vnum zero = v_splat(0), one = v_splat(1);
    return v_sub(v_add(a, v_select(more, one, zero)), v_select(less, one, zero));
}

/* The same of all lanes, where planes are floats: the first guess is at most one off. */
static lane_cells ask_float_planes(const tribox_float_lattice *lattice, int a, lane_cells guess, lane_ends ends)
{
    const vnum cell = v_splat(lattice->cell[a]), origin = v_splat(lattice->origin[a]);
    const vnum first = v_fma(guess.first, cell, origin), last = v_fma(guess.last, cell, origin);
    const vnum above_first = v_add(first, cell), above_last = v_add(last, cell);
    return (lane_cells){plus_where(guess.first, v_gt(ends.least, above_first), m_not(v_gt(ends.least, first))),
                        plus_where(guess.last, m_not(v_gt(above_last, ends.most)), v_gt(last, ends.most))};
}

/* A window in all lanes, once for all packets: a splat of a number in memory is as dear as an operation. */
typedef struct lane_axis {
    vnum origin, per_cell, off_middle, size, certain; /* no place so near to the middle of a cell is in doubt */
} lane_axis;
typedef struct lane_window {
    lane_axis axis[3];
    vnum first_layer, end_layer; /* of those that are written */
} lane_window;

TRIBOX_INLINE void spread_window(const tribox_voxel_window *w, lane_window *lanes)
{
    const tribox_float_lattice *const f = &w->in_float;
    lanes->first_layer = v_splat((float)w->first_layer);
    lanes->end_layer = v_splat((float)w->end_layer);
    for (int a = 0; a < 3; a++) {
        lanes->axis[a].origin = v_splat(f->origin[a]);
        lanes->axis[a].per_cell = v_splat(f->per_cell[a]);
        lanes->axis[a].off_middle = v_splat(f->off_middle[a]);
        lanes->axis[a].size = v_splat(f->size[a]);
        lanes->axis[a].certain = v_splat(0.5f - f->doubt[a]);
    }
}

/* The place of x less half a cell, so that the nearest whole number is its cell. */
TRIBOX_INLINE vnum middle_of(vnum x, const lane_axis *axis)
{
    return v_min(v_max(v_fma(v_sub(x, axis->origin), axis->per_cell, axis->off_middle), v_splat(-1)), axis->size);
}

enum { REACH_AHEAD = 64 }; /* triangles */

TRIBOX_INLINE void reach_axis(lane_reach *r, const tribox_voxel_window *w, const lane_axis *axis, int a,
                              const float *const stream[3], size_t at)
{
    for (int j = 0; j < 3; j++) {
        r->u[3 * a + j] = v_load(stream[j] + at);
        if (V_LANES > 4) /* the others are slower than memory is */
            tribox_will_read(stream[j] + at + REACH_AHEAD);
    }
    const tribox_float_lattice *const lattice = &w->in_float;
    const vnum zero = v_splat(0), size = axis->size;
    const vnum least = lane_min3(r->u[3 * a], r->u[3 * a + 1], r->u[3 * a + 2]);
    const vnum most = lane_max3(r->u[3 * a], r->u[3 * a + 1], r->u[3 * a + 2]);
    const vnum from = middle_of(least, axis), to = middle_of(most, axis);
    lane_cells c = {v_nearest(from), v_nearest(to)};
    const vnum off = v_max(v_abs(v_sub(from, c.first)), v_abs(v_sub(to, c.last)));
    const vmask in_doubt = v_gt(off, axis->certain);
    if (m_bits(in_doubt) && lattice->cell[a] > 0)
        c = ask_float_planes(lattice, a, c, (lane_ends){least, most, from, to});
    else if (m_bits(in_doubt) && !w->doubles)
        c = ask_planes_of_floats(w, a, in_doubt, c, (lane_ends){least, most, from, to});
    else if (m_bits(in_doubt))
        c = ask_planes(w, r, a, m_bits(m_and(in_doubt, r->inside)), c, (lane_ends){least, most, from, to});
    r->spans[a] = v_gt(c.last, c.first);
    r->inside = m_andnot(m_and(r->inside, v_gt(size, c.first)), v_gt(zero, c.last));
    r->base[a] = v_max(c.first, zero);
    r->cells[a] = v_sub(v_min(v_add(c.last, v_splat(1)), size), r->base[a]);
}
