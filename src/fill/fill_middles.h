/*
 * fill_middles.h - the middles of cells of a grid, and where a number lies among them. Call in the environment of environment.h.
 */
#ifndef TRIBOX_FILL_MIDDLES_H
#define TRIBOX_FILL_MIDDLES_H

#include "base/finite.h"
#include "grid/grid_cells.h"

/*
 * A window of a grid, and places of numbers in it: (number - origin) per_cell, off from where planes and middles lie by `error` at
 * most. origin is the window's first plane.
 */
typedef struct tribox_middles {
    tribox_planes planes;
    uint32_t size[3];
    double origin[3], cell[3], per_cell[3], error[3];
    double off[3];   /* how far from the middle of cell i origin + (i + 1/2) cell can be, in double */
    bool has_places; /* errors are less than a quarter of a cell */

    /*
     * On x each cell has a mark, and crossings are told by the first mark past them: its middle, with place i + 1/2. Or its upper
     * plane, where origin is half a cell more; then the lowest plane is the mark of cell -1.
     */
    bool are_planes;
    double least; /* place, to which crossings before all marks are cut off: 0, or -1 */
} tribox_middles;

/* Of a window of a sound grid. Planes are off by half a spacing of doubles, as are their means. */
static inline tribox_middles tribox_middles_of(const tribox_grid *grid, const tribox_window *window)
{
    tribox_middles m = {.planes = tribox_planes_of(grid, window->first), .has_places = true};
    for (int a = 0; a < 3; a++) {
        const double cell = grid->cell[a];
        const double lowest = tribox_plane_at(&m.planes, a, 0), highest = tribox_plane_at(&m.planes, a, window->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        m.size[a] = window->size[a];
        m.origin[a] = lowest;
        m.cell[a] = cell;
        m.per_cell[a] = 1 / cell;
        m.error[a] = 0x1p-51 * farthest * m.per_cell[a] + 0x1p-50 * ((double)m.size[a] + 4);
        m.off[a] = 0x1p-50 * farthest + m.error[a] * cell;
        m.has_places = m.has_places && cell >= 0x1p-700 && cell <= 0x1p700 && m.error[a] < 0.25;
    }
    return m;
}

/*
 * The double nearest to the mean, rounded once, as a sum is exact where its half is subnormal. Of neighbouring doubles it is the
 * lower one: a middle on the upper plane is moved out of its cell (PROOFS.md 15.2, 15.7).
 */
static inline double tribox_mean(double lo, double hi)
{
    const double sum = lo + hi, mean = tribox_is_finite_double(sum) ? sum / 2 : lo / 2 + hi / 2;
    return mean < hi ? mean : lo;
}

static inline double tribox_middle(const tribox_middles *m, int a, int64_t cell)
{
    return tribox_mean(tribox_plane_at(&m->planes, a, cell), tribox_plane_at(&m->planes, a, cell + 1));
}

/* Of whose cells the marks on x are their upper planes: farther off than middles they are not, so errors are the same. */
static inline tribox_middles tribox_marks_of(const tribox_grid *grid, const tribox_window *window)
{
    tribox_middles m = tribox_middles_of(grid, window);
    m.are_planes = true;
    m.origin[0] += m.cell[0] / 2;
    m.least = -1;
    return m;
}

static inline double tribox_mark(const tribox_middles *m, int64_t cell)
{
    return m->are_planes ? tribox_plane_at(&m->planes, 0, cell + 1) : tribox_middle(m, 0, cell);
}

#endif
