/* strips.h - the cells of triangles in strips, and the kernel's table. After: columns.h, packed_rows.h. Needs: KERNEL. */

TRIBOX_INLINE void set_strip_by(tribox_voxels *v, tribox_shape shape, bool has_certain)
{
    const tribox_strip *const strip = &v->strip[shape];
    strip_limits limits;
    prepare(strip, &v->lattice, v->plan.axes, v->plan.accuracy == TRIBOX_FAST ? 0 : 1, &limits, shape);
    for (unsigned t = 0; t < strip->count; t++) {
        const int64_t base = (int64_t)strip->base[2][t], layers = (int64_t)strip->cells[2][t];
        const strip_place p = {
            v, strip, &limits, t, tribox_greatest(v->first_layer - base, 0), tribox_least(layers, v->end_layer - base)};
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

extern const tribox_grid_kernel TRIBOX_SYMBOL(grid);
const tribox_grid_kernel TRIBOX_SYMBOL(grid) = {
    .set_strip = {set_solid, set_flat_x, set_flat_y, set_flat_z},
};
