/* grid_places.h - planes of a grid and boxes of its tiles, by their definition in tribox.h. */
#ifndef TRIBOX_TESTS_GRID_PLACES_H
#define TRIBOX_TESTS_GRID_PLACES_H

#include <math.h>

#include "tribox.h"

/* Plane p of an axis, as C's fma says. */
static inline double plane_of(const tribox_grid *grid, int a, double p) { return fma(p, grid->cell[a], grid->origin[a]); }

/* Of so many cells a side, the last of an axis of as many as are left; of one cell, that cell. */
static inline tribox_box box_of_tile(const tribox_grid *grid, uint32_t side, size_t tile)
{
    tribox_box box;
    for (int a = 0; a < 3; a++) {
        const uint32_t size = grid->size[a], along = size / side + (size % side != 0), first = (uint32_t)(tile % along) * side;
        box.lo[a] = plane_of(grid, a, first);
        box.hi[a] = plane_of(grid, a, side < size - first ? first + side : size);
        tile /= along;
    }
    return box;
}

#endif
