/*
 * fill_middles.h - the middles of cells of a grid of floats or doubles, and where a number lies among them. Call in the environment
 * of environment.h.
 */
#ifndef TRIBOX_FILL_MIDDLES_H
#define TRIBOX_FILL_MIDDLES_H

#include "base/finite.h"
#include "grid/grid_cells.h"
#include "grid/planes.h"

/* A grid, and places of numbers in it: (number - origin) per_cell, off from where planes and middles lie by `error` at most. */
typedef struct tribox_middles {
    const tribox_grid *grid; /* of floats, or NULL */
    tribox_planes planes;    /* of doubles */
    const uint32_t *size;
    double origin[3], cell[3], per_cell[3], error[3];
    double off[3];   /* by which tribox_middle_near errs at the most */
    bool has_places; /* errors are less than a quarter of a cell */
} tribox_middles;

/* Of a sound grid: one of the two is NULL. */
tribox_middles tribox_middles_of(const tribox_grid *grid, const tribox_grid_f64 *grid_f64);

static inline double tribox_middles_plane(const tribox_middles *m, int a, int64_t p)
{
    return m->grid ? tribox_grid_plane(m->grid, a, (uint64_t)p) : tribox_plane_at(&m->planes, a, p);
}

/* The double nearest to the mean: rounded once, as a sum is exact where its half is subnormal (PROOFS.md 15.2). */
static inline double tribox_mean(double lo, double hi)
{
    const double sum = lo + hi;
    return tribox_is_finite_f64(sum) ? sum / 2 : lo / 2 + hi / 2;
}

static inline double tribox_middle(const tribox_middles *m, int a, int64_t cell)
{
    return tribox_mean(tribox_middles_plane(m, a, cell), tribox_middles_plane(m, a, cell + 1));
}

/* Planes of doubles are rounded once, which takes its time. */
static inline double tribox_middle_near(const tribox_middles *m, int a, int64_t cell)
{
    return m->grid ? tribox_middle(m, a, cell) : m->origin[a] + ((double)cell + 0.5) * m->cell[a];
}

/* The closed cells of axis a that an interval touches, -1 and size standing for those outside the grid. */
tribox_cells tribox_middles_cells(const tribox_middles *m, int a, double least, double most);

#endif
