/* fill_middles.c - grids of floats and of doubles, for those who ask for the middles of cells. */
#include "fill_middles.h"

#include "grid/grid_f64.h"

/* Planes of floats are off by half a spacing of floats, planes of doubles by that of doubles, as are their means. */
static void set_places(tribox_middles *m, int a, double cell)
{
    const double lowest = tribox_middles_plane(m, a, 0), highest = tribox_middles_plane(m, a, m->size[a]);
    const double farthest = -lowest > highest ? -lowest : highest;
    m->origin[a] = lowest;
    m->cell[a] = cell;
    m->per_cell[a] = 1 / cell;
    m->error[a] = (m->grid ? 0x1.01p-24 : 0x1p-51) * farthest * m->per_cell[a] + 0x1p-50 * ((double)m->size[a] + 4);
    m->off[a] = m->grid ? 0 : 0x1p-50 * farthest + m->error[a] * cell;
    m->has_places = m->has_places && cell >= 0x1p-700 && cell <= 0x1p700 && m->error[a] < 0.25;
}

tribox_middles tribox_middles_of(const tribox_grid *grid, const tribox_grid_f64 *grid_f64)
{
    tribox_middles m = {.grid = grid, .size = grid ? grid->size : grid_f64->size, .has_places = true};
    if (!grid)
        m.planes = tribox_planes_of(grid_f64, NULL);
    for (int a = 0; a < 3; a++)
        set_places(&m, a, grid ? grid->cell[a] : grid_f64->cell[a]);
    return m;
}

tribox_cells tribox_middles_cells(const tribox_middles *m, int a, double least, double most)
{
    return m->grid ? tribox_grid_cells(m->grid, a, 0, m->size[a], (float)least, (float)most)
                   : tribox_planes_cells(&m->planes, a, m->size[a], least, most);
}
