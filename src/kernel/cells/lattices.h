/*
 * lattices.h - a window of a grid as a grid of its own: how places in it are told, in double and in float.
 * After: voxelizing.h. In plain C: it is here for the planes, one operation each where that is fused, and dozens elsewhere.
 */

/* About the window's first planes. */
TRIBOX_INLINE void make_places(const tribox_voxel_window *w, tribox_lattice *lattice)
{
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_plane_at(&w->planes, a, 0);
        const double highest = w->planes.origin[a] + (w->planes.first[a] + w->size[a]) * w->planes.cell[a]; /* nearly */
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice->origin[a] = lowest;
        lattice->per_cell[a] = 1 / w->planes.cell[a];
        /* planes: half a spacing of doubles for the first and for each; places: three roundings (PROOFS.md 7.2) */
        lattice->error[a] = 0x1.001p-52 * farthest * lattice->per_cell[a] + 0x1p-50 * ((double)w->size[a] + 4);
    }
}

/*
 * Whether limits hold in double: planes are much farther apart than doubles, and cells of a size whose products neither overflow
 * nor vanish (PROOFS.md 7.10).
 */
TRIBOX_INLINE bool is_for_limits(const tribox_voxel_window *w)
{
    bool fits = true;
    for (int a = 0; a < 3; a++)
        fits &=
            w->size[a] <= 1 << 30 && w->planes.cell[a] >= 0x1p-700 && w->planes.cell[a] <= 0x1p700 && w->lattice.error[a] < 0.25;
    return fits;
}

/* Edges of floats are 0 or 2^-149 to 2^129 long. */
TRIBOX_INLINE bool has_all_limits(const tribox_voxel_window *w)
{
    bool has = !w->doubles;
    for (int a = 0; a < 3; a++)
        has &= w->planes.cell[a] >= 0x1p-100 && w->planes.cell[a] <= 0x1p100;
    return has;
}

/*
 * Whether float makes origin + p cell without rounding, for p from -1 to size + 1: all of these, and p cell, are multiples of the
 * spacing of floats at `far_off`, and no more than half of it away from zero.
 */
TRIBOX_INLINE bool has_float_planes(float origin, double cell, float size)
{
    const float narrow = (float)cell, far_off = 4 * ((float)fabs(origin) + (size + 2) * narrow);
    return narrow == cell && far_off + narrow - far_off == narrow && far_off + origin - far_off == origin;
}

/*
 * The lattice in float: about the float nearest to the first plane, or of doubles about the plane itself. Float is a filter where
 * it tells places in the window apart by less than half a cell, and nothing overflows (PROOFS.md 7.9): whether it does.
 */
TRIBOX_INLINE bool make_float(tribox_voxel_window *w)
{
    tribox_float_lattice *const f = &w->in_float;
    bool fits = true;
    for (int a = 0; a < 3; a++) {
        f->origin[a] = w->doubles ? 0 : (float)w->lattice.origin[a];
        const bool is_float = !w->doubles && f->origin[a] == w->lattice.origin[a];
        const double off = w->doubles ? 0 : (f->origin[a] - w->lattice.origin[a]) * w->lattice.per_cell[a];
        f->per_cell[a] = (float)w->lattice.per_cell[a];
        f->size[a] = (float)w->size[a];
        f->off[a] = (float)off;
        f->off_middle[a] = (float)(off - 0.5);
        f->cell[a] = is_float && has_float_planes(f->origin[a], w->planes.cell[a], f->size[a]) ? (float)w->planes.cell[a] : 0;
        f->error[a] = (float)(w->lattice.error[a] + 0x1.4p-21 * fabs(off)) * 1.001f;
        f->doubt[a] = f->error[a] + (f->size[a] + 1) * 0x1.4p-22f;
        fits &= w->size[a] <= 1 << 20 && f->per_cell[a] >= 0x1p-100f && f->per_cell[a] <= 0x1p100f && f->doubt[a] < 0.5f;
    }
    return fits;
}

/*
 * Where the plane alone is asked besides the box normals, floats cannot stand for doubles: it turns with the smallest of moves.
 * Without the box normals a triangle may overlap cells anywhere.
 */
TRIBOX_INLINE bool is_for_packets(const tribox_voxel_window *w, unsigned axes)
{
    const bool has_moves = !w->doubles || axes == TRIBOX_AXES_BOX || axes & TRIBOX_AXES_EDGES;
    return axes & TRIBOX_AXES_BOX && has_moves && w->has_limits;
}

static void make_window(tribox_voxel_window *w, const tribox_grid *grid, const tribox_window *asked, const tribox_mesh *doubles,
                        unsigned axes)
{
    for (int a = 0; a < 3; a++) {
        w->planes.origin[a] = grid->origin[a];
        w->planes.cell[a] = grid->cell[a];
        w->planes.first[a] = asked->first[a];
        w->size[a] = asked->size[a];
    }
    w->first_layer = 0;
    w->end_layer = asked->size[2];
    w->doubles = doubles;
    w->first_triangle = 0;
    w->has_numbers = doubles;
    w->number = NULL;
    make_places(w, &w->lattice);
    w->has_limits = is_for_limits(w);
    w->has_all_limits = w->has_limits && has_all_limits(w);
    w->is_for_float = make_float(w) && is_for_packets(w, axes);
}
