/*
 * solids.h - triangles whose boxes span few cells on all axes, a packet of them at once: row by row, triangle by lane, in float.
 * After: reach.h, writes.h, runs.h. Needs: nothing more.
 *
 * The shadow along x takes or leaves whole rows; the two others limit each row and each layer, and the plane limits the rows.
 */

TRIBOX_NOINLINE tribox_triangle triangle_of_doubles(const tribox_voxel_window *w, int32_t number)
{
    return tribox_window_read_triangle(w, number);
}

/* The triangle with this number: of floats, a stride apart, or of doubles. */
TRIBOX_INLINE tribox_triangle triangle_of_lane(const tribox_voxels *v, const float *u, size_t stride, int32_t number)
{
    tribox_triangle triangle = {.number = number};
    if (v->window.doubles)
        return triangle_of_doubles(&v->window, number);
    for (size_t n = 0; n < 9; n++)
        triangle.u[n] = u[n * stride];
    return triangle;
}

/* Open cells wait with their triangles: bits along x from cell (i, j, k) on. */
TRIBOX_INLINE void wait_for_lanes(tribox_voxels *v, const tribox_queue *queue, unsigned at, vint undecided, const vint cell[3])
{
    tribox_waiting *const w = &v->sinks.waiting;
    const vmask m = m_has_bits(undecided);
    const unsigned added = m_count(m);
    if (w->count + added > TRIBOX_WAITING)
        v->sinks.handlers->settle_waiting(v);
    if (v->window.has_numbers)
        i_pack(&w->number[w->count], m, i_load(&queue->triangle[at]));
    for (int n = 0; n < 9 && !v->window.doubles; n++)
        v_pack(&w->u[n][w->count], m, v_load(&queue->number[n][at]));
    for (int a = 0; a < 3; a++)
        i_pack(&w->at[a][w->count], m, cell[a]);
    i_pack(&w->bits[w->count], m, undecided);
    w->count += added;
}

/* Triangles of a queue that another way has to take. */
TRIBOX_NOINLINE void defer_queued(tribox_voxels *v, const tribox_queue *queue, unsigned at, uint64_t lanes)
{
    for (; lanes; lanes &= lanes - 1) {
        const unsigned t = at + tribox_lowest_bit(lanes);
        const tribox_triangle triangle =
            triangle_of_lane(v, &queue->number[0][t], TRIBOX_QUEUE + TRIBOX_LANES_MAX, queue->triangle[t]);
        v->sinks.handlers->add_triangle(v, &triangle);
    }
}

/* Places on axis a of the triangles of a queue. Those that are wild join the others. */
TRIBOX_INLINE lane_places queued_places(const tribox_voxels *v, const tribox_queue *queue, unsigned at, int a, vmask *wild)
{
    const tribox_float_lattice *const lattice = &v->window.in_float;
    const vnum u[3] = {v_load(&queue->number[3 * a][at]), v_load(&queue->number[3 * a + 1][at]),
                       v_load(&queue->number[3 * a + 2][at])};
    const vnum base = v_sub(v_load(&queue->number[9 + a][at]), v_splat(lattice->off[a]));
    const lane_places p = places_of(u, base, v_load(&queue->number[12 + a][at]), v_splat(lattice->origin[a]),
                                    v_splat(lattice->per_cell[a]), v_splat(lattice->error[a]));
    *wild = m_or(*wild, is_wild(u, &p));
    return p;
}

/* Of these lanes. Where is_exact, certain cells are listed and undecided ones wait; else all that may overlap are listed. */
TRIBOX_INLINE void set_solids(tribox_voxels *v, const tribox_queue *queue, unsigned at, vmask asked, bool is_exact)
{
    const vnum bound_scale = v_splat(v->plan.accuracy == TRIBOX_FAST ? 0 : 1);
    const vmask has_edges = v->plan.axes & TRIBOX_AXES_EDGES ? m_all() : m_none();
    const vmask has_plane = v->plan.axes & TRIBOX_AXES_PLANE ? m_all() : m_none();
    lane_places p[3];
    vnum base[3], cells[3];
    vmask wild = m_none();
    for (int a = 0; a < 3; a++) {
        base[a] = v_load(&queue->number[9 + a][at]);
        cells[a] = v_load(&queue->number[12 + a][at]);
        p[a] = queued_places(v, queue, at, a, &wild);
    }
    const vnum side_error = v_mul(bound_scale, shadow_error(&p[1], &p[2])), none = v_sub(v_splat(0), side_error);
    shadow_side side[3];
    for (int e = 0; e < 3; e++)
        side[e] = side_of_shadow(&p[1], &p[2], e, has_edges);
    const shadow_limits zx = limits_of(&p[0], &p[2], bound_scale, has_edges), xy = limits_of(&p[0], &p[1], bound_scale, has_edges);
    const plane_limits plane = plane_of(p, bound_scale, has_plane);

    const lane_bits bits = bits_at(v, base);
    const int32_t *const number = listed_numbers(v, &queue->triangle[at]);
    const vmask present = m_andnot(asked, wild);
    lane_run in_row[TRIBOX_SOLID_MOST];
    int rows = 0;
    for (; rows < TRIBOX_SOLID_MOST && m_bits(m_and(present, v_gt(cells[1], v_splat((float)rows)))); rows++)
        in_row[rows] = run_within(&xy, cells[0], v_splat((float)rows), is_exact);
    for (int layer = 0; layer < TRIBOX_SOLID_MOST; layer++) {
        const vnum k = v_splat((float)layer), z = v_add(base[2], k);
        const vmask has_layer = m_and(present, v_gt(cells[2], k));
        const vmask in_k = m_andnot(m_andnot(has_layer, v_gt(v_splat((float)v->window.first_layer), z)),
                                    m_not(v_gt(v_splat((float)v->window.end_layer), z)));
        if (!m_bits(has_layer))
            break;
        const lane_run in_layer = run_within(&zx, cells[0], k, is_exact);
        vnum side_k[3];
        for (int e = 0; e < 3; e++)
            side_k[e] = side_in_row(&side[e], k);
        const vnum plane_k = v_mul(plane.k_slope, k);
        vint half = i_add(bits.half, i_splat((int32_t)((uint32_t)layer * (uint32_t)v->sinks.layer_halves)));
        make_room(v);
        for (int row = 0; row < rows; row++) {
            const vnum j = v_splat((float)row);
            const vmask in_window = m_and(in_k, v_gt(cells[1], j));
            const vnum slack = lane_min3(side_in_cell(&side[0], j, side_k[0]), side_in_cell(&side[1], j, side_k[1]),
                                         side_in_cell(&side[2], j, side_k[2]));
            const lane_run of_plane = run_by_plane(&plane, v_fma(plane.j_slope, j, plane_k));
            const vmask may_side = m_andnot(in_window, v_gt(none, slack));
            lane_run run = in_row[row];
            narrow_to(&run, &in_layer, is_exact);
            narrow_to(&run, &of_plane, is_exact);
            vint set = set_bits(&run, is_exact);
            if (is_exact) {
                const vmask by_side = v_gt(side_error, slack), open = m_and(may_side, m_or(by_side, has_open_ends(&run)));
                set = i_keep(m_andnot(in_window, by_side), set);
                if (m_bits(open)) {
                    const vint undecided = i_andnot(i_keep(open, set_bits(&run, false)), set);
                    const vint cell[3] = {i_cut(base[0]), i_cut(v_add(base[1], j)), i_cut(z)};
                    wait_for_lanes(v, queue, at, undecided, cell);
                }
            } else {
                set = i_keep(may_side, set);
            }
            list_bits(v, half, bits.from, set, number);
            half = i_add(half, i_splat(v->sinks.row_halves));
        }
    }
    defer_queued(v, queue, at, m_bits(m_and(asked, wild)));
}
