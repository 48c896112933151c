/*
 * flats.h - triangles whose boxes are one layer of cells across an axis, a packet of them at once: their shadows alone, in float.
 * After: solids.h. Needs: nothing more.
 *
 * Axis q is x, or y of triangles in a layer across x; axis p is z, or y of triangles in a layer across z. Of a row p the cells
 * along q are limited (PROOFS.md 7.4).
 */
TRIBOX_INLINE vnum either(vmask m, float a, float b) { return v_select(m, v_splat(a), v_splat(b)); }

/* Places on the one or the other axis. */
TRIBOX_INLINE lane_places flat_places(const tribox_voxels *v, const tribox_queue *queue, unsigned at, vmask m, int a, int b,
                                      vmask *wild)
{
    const tribox_float_lattice *const lattice = &v->window.in_float;
    vnum u[3];
    for (int j = 0; j < 3; j++)
        u[j] = v_select(m, v_load(&queue->number[3 * a + j][at]), v_load(&queue->number[3 * b + j][at]));
    const vnum base = v_select(m, v_load(&queue->number[9 + a][at]), v_load(&queue->number[9 + b][at]));
    const lane_places p =
        places_of(u, v_sub(base, either(m, lattice->off[a], lattice->off[b])),
                  v_select(m, v_load(&queue->number[12 + a][at]), v_load(&queue->number[12 + b][at])),
                  either(m, lattice->origin[a], lattice->origin[b]), either(m, lattice->per_cell[a], lattice->per_cell[b]),
                  either(m, lattice->error[a], lattice->error[b]));
    *wild = m_or(*wild, is_wild(u, &p));
    return p;
}

/* Lists cells along y: bit n of `set` is the cell n rows on. */
TRIBOX_INLINE void list_column(tribox_voxels *v, vint half, vint from, vint set, const int32_t *number)
{
    const vint bit = i_shl(i_splat(1), from);
    for (vint row = i_splat(1); m_bits(m_has_bits(set)); row = i_add(row, row), half = i_add(half, i_splat(v->sinks.row_halves))) {
        make_room(v);
        list(v, m_has_bits(i_and(set, row)), half, bit, number);
        set = i_andnot(set, row);
    }
}

/* Open cells along y. */
TRIBOX_NOINLINE void wait_for_columns(tribox_voxels *v, const tribox_queue *queue, unsigned at, vint undecided, const vint cell[3])
{
    const vint one = i_splat(1);
    vint above[3] = {cell[0], cell[1], cell[2]};
    for (; m_bits(m_has_bits(undecided)); undecided = i_shr(undecided, one), above[1] = i_add(above[1], one))
        wait_for_lanes(v, queue, at, i_and(undecided, one), above);
}

TRIBOX_INLINE void set_flats(tribox_voxels *v, const tribox_queue *queue, unsigned at, vmask asked, bool is_exact)
{
    vnum base[3], cells[3];
    for (int a = 0; a < 3; a++) {
        base[a] = v_load(&queue->number[9 + a][at]);
        cells[a] = v_load(&queue->number[12 + a][at]);
    }
    const vmask is_x = v_is_zero(cells[0]), is_z = v_is_zero(cells[2]);
    vmask wild = m_none();
    const lane_places q = flat_places(v, queue, at, is_x, 1, 0, &wild), p = flat_places(v, queue, at, is_z, 1, 2, &wild);
    const vnum bound_scale = v_splat(v->plan.accuracy == TRIBOX_FAST ? 0 : 1);
    const shadow_limits limits = limits_of(&q, &p, bound_scale, m_all());
    const vnum along = v_select(is_x, cells[1], cells[0]), rows = v_select(is_z, cells[1], cells[2]);
    const vint step = i_or(i_keep(is_z, i_splat(v->sinks.row_halves)), i_keep(m_not(is_z), i_splat(v->sinks.layer_halves)));
    const vnum layers = either(is_z, 0, 1);
    const lane_bits bits = bits_at(v, base);
    const int32_t *const number = listed_numbers(v, &queue->triangle[at]);
    vint half = bits.half;
    for (int row = 0; row < TRIBOX_FLAT_MOST; row++, half = i_add(half, step)) {
        const vnum r = v_splat((float)row), z = v_fma(layers, r, base[2]);
        const vmask has_row = m_andnot(m_and(asked, v_gt(rows, r)), wild);
        const vmask in_window = m_andnot(m_andnot(has_row, v_gt(v_splat((float)v->window.first_layer), z)),
                                         m_not(v_gt(v_splat((float)v->window.end_layer), z)));
        if (!m_bits(has_row))
            break;
        const lane_run run = run_within(&limits, along, r, is_exact);
        const vint set = i_keep(in_window, set_bits(&run, is_exact));
        if (is_exact) {
            const vmask open = m_and(in_window, has_open_ends(&run));
            if (m_bits(open)) {
                const vint undecided = i_andnot(i_keep(open, set_bits(&run, false)), set);
                const vint cell[3] = {i_cut(base[0]), i_cut(v_add(base[1], v_select(is_z, r, v_splat(0)))), i_cut(z)};
                wait_for_lanes(v, queue, at, i_keep(m_not(is_x), undecided), cell);
                wait_for_columns(v, queue, at, i_keep(is_x, undecided), cell);
            }
        }
        make_room(v);
        list_bits(v, half, bits.from, i_keep(m_not(is_x), set), number);
        list_column(v, half, bits.from, i_keep(is_x, set), number);
    }
    defer_queued(v, queue, at, m_bits(m_and(asked, wild)));
}
