/*
 * strips.h - the cells of triangles in strips, and the kernel's table. After: packed_rows.h, crossings.h. Needs: KERNEL.
 */

TRIBOX_INLINE void set_rows(const strip_place *p, tribox_shape shape, bool has_certain)
{
    const int bit = p->strip->bit[p->t];
    const bool is_narrow = bit + p->strip->cells[0][p->t] < 64;
    row_cursor at = first_rows(p, shape);
    row_list rows;
    while (list_rows(p, &at, &rows, shape, has_certain)) {
        const row_cells *const cells = has_certain ? &rows.certain : &rows.maybe;
        limit_all_rows(p, &rows, shape, has_certain);
        if (p->v->sinks.ids.of && is_narrow)
            lower_narrow_rows(p, &rows, cells);
        else if (p->v->sinks.ids.of)
            lower_wide_rows(p, &rows, cells);
        if (p->v->sinks.pairs)
            pair_rows(p, &rows, cells);
        else
            p->v->counts.overlapping += set_listed_rows(p->v->sinks.occupied, &rows, cells, bit, is_narrow);
        if (has_certain && may_be_undecided(&rows))
            wait_for_rows(p, &rows);
    }
}

TRIBOX_INLINE void set_strip_by(tribox_voxels *v, tribox_shape shape, bool has_certain)
{
    const tribox_strip *const strip = &v->sinks.strip[shape];
    strip_limits limits;
    prepare_limits(strip, &v->window.lattice, v->plan.axes, v->plan.accuracy == TRIBOX_FAST ? 0 : 1, &limits, shape);
    for (unsigned t = 0; t < strip->count; t++) {
        const int64_t base = (int64_t)strip->base[2][t], layers = (int64_t)strip->cells[2][t];
        const strip_place p = {v,
                               strip,
                               &limits,
                               t,
                               tribox_greatest(v->window.first_layer - base, 0),
                               tribox_least(layers, v->window.end_layer - base)};
        if (shape == TRIBOX_FLAT_X)
            set_columns(&p, has_certain);
        else
            set_rows(&p, shape, has_certain);
    }
}

TRIBOX_INLINE void set_strip(tribox_voxels *v, tribox_shape shape)
{
    if (v->plan.accuracy == TRIBOX_EXACT)
        set_strip_by(v, shape, true);
    else
        set_strip_by(v, shape, false);
}

static void set_solid(tribox_voxels *v) { set_strip(v, TRIBOX_SOLID); }
static void set_flat_x(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_X); }
static void set_flat_y(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_Y); }
static void set_flat_z(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_Z); }

extern const tribox_rows_kernel TRIBOX_SYMBOL(rows);
const tribox_rows_kernel TRIBOX_SYMBOL(rows) = {
    .set_strip = {set_solid, set_flat_x, set_flat_y, set_flat_z},
    .cross = cross_triangles,
};
