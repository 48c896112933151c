/* grid_cells.h - the planes of a grid, and the cells that an interval touches. Call in the environment of environment.h. */
#ifndef TRIBOX_GRID_CELLS_H
#define TRIBOX_GRID_CELLS_H

#include <stdbool.h>

#include "tribox.h"

/* Plane p of axis a: the float nearest to origin + p cell, evaluated in double. */
static inline float tribox_grid_plane(const tribox_grid *grid, int a, uint64_t p)
{
    return (float)((double)grid->origin[a] + (double)p * (double)grid->cell[a]);
}

/* Whether the grid can be served: finite planes in strictly rising order, and cells on every axis. */
bool tribox_grid_is_sound(const tribox_grid *grid);

/* Whether a call may write so many cells: 2^31 words. */
bool tribox_fits_one_call(const uint32_t size[3]);

/* Cells of a window, first to last: -1 stands for all below it, its size for all above. */
typedef struct tribox_cells {
    int64_t first, last;
} tribox_cells;

/* The closed cells of axis a, from `first` on and `size` of them, that the interval [least, most] of finite numbers touches. */
tribox_cells tribox_grid_cells(const tribox_grid *grid, int a, int64_t first, int64_t size, float least, float most);

#endif
