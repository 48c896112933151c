/* window.c - a window of a grid as a grid of its own: how places in it are told, in double and in float. */
#include "window.h"

static double magnitude(double x) { return x < 0 ? -x : x; }

/* About the window's first planes. */
static tribox_lattice lattice_of(const tribox_voxel_window *w)
{
    tribox_lattice lattice;
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_plane_at(&w->planes, a, 0), highest = tribox_plane_at(&w->planes, a, w->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = lowest;
        lattice.per_cell[a] = 1 / w->planes.cell[a];
        /* planes: half a spacing of doubles for the first and for each; places: three roundings (PROOFS.md 7.2) */
        lattice.error[a] = 0x1.001p-52 * farthest * lattice.per_cell[a] + 0x1p-50 * ((double)w->size[a] + 4);
    }
    return lattice;
}

/*
 * Whether limits hold in double: planes are much farther apart than doubles, and cells of a size whose products neither overflow
 * nor vanish (PROOFS.md 7.10).
 */
static bool is_for_limits(const tribox_voxel_window *w)
{
    bool fits = true;
    for (int a = 0; a < 3; a++)
        fits &=
            w->size[a] <= 1 << 30 && w->planes.cell[a] >= 0x1p-700 && w->planes.cell[a] <= 0x1p700 && w->lattice.error[a] < 0.25;
    return fits;
}

/* Edges of floats are 0 or 2^-149 to 2^129 long. */
static bool has_all_limits(const tribox_voxel_window *w)
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
static bool has_float_planes(float origin, double cell, float size)
{
    const float narrow = (float)cell, far_off = 4 * ((float)magnitude(origin) + (size + 2) * narrow);
    return narrow == cell && far_off + narrow - far_off == narrow && far_off + origin - far_off == origin;
}

/*
 * The lattice in float: about the float nearest to the first plane, or of doubles about the plane itself. Float is a filter where
 * it tells places in the window apart by less than half a cell, and nothing overflows (PROOFS.md 7.9): whether it does.
 */
static bool make_float(tribox_voxel_window *w)
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
        f->error[a] = (float)(w->lattice.error[a] + 0x1.4p-21 * magnitude(off)) * 1.001f;
        f->doubt[a] = f->error[a] + (f->size[a] + 1) * 0x1.4p-22f;
        fits &= w->size[a] <= 1 << 20 && f->per_cell[a] >= 0x1p-100f && f->per_cell[a] <= 0x1p100f && f->doubt[a] < 0.5f;
    }
    return fits;
}

/*
 * Where the plane alone is asked besides the box normals, floats cannot stand for doubles: it turns with the smallest of moves.
 * Without the box normals a triangle may overlap cells anywhere.
 */
static bool is_for_packets(const tribox_voxel_window *w, unsigned axes)
{
    const bool has_moves = !w->doubles || axes == TRIBOX_AXES_BOX || axes & TRIBOX_AXES_EDGES;
    return axes & TRIBOX_AXES_BOX && has_moves && w->has_limits;
}

void tribox_voxel_window_make(tribox_voxel_window *w, const tribox_grid *grid, const tribox_window *asked,
                              const tribox_triangles *triangles, unsigned axes)
{
    w->planes = tribox_planes_of(grid, asked->first);
    memcpy(w->size, asked->size, sizeof w->size);
    w->first_layer = 0;
    w->end_layer = asked->size[2];
    w->doubles = triangles->are_doubles ? &triangles->mesh : NULL;
    w->first_triangle = 0;
    w->has_numbers = triangles->are_doubles;
    w->number = NULL;
    w->lattice = lattice_of(w);
    w->has_limits = is_for_limits(w);
    w->has_all_limits = w->has_limits && has_all_limits(w);
    w->is_for_float = make_float(w) && is_for_packets(w, axes);
}
