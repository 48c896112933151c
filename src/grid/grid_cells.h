/* grid_cells.h - whether a grid can be served, and which cells an interval touches. Call in the environment of environment.h. */
#ifndef TRIBOX_GRID_CELLS_H
#define TRIBOX_GRID_CELLS_H

#include <stdbool.h>

#include "planes.h"
#include "tribox.h"

/* Whether the grid can be served: finite planes in strictly rising order, and cells on every axis. */
bool tribox_grid_is_sound(const tribox_grid *grid);

/* Whether a call may write so many cells: 2^31 words. */
bool tribox_fits_one_call(const uint32_t size[3]);

/* Whether the window lies in the grid. */
bool tribox_grid_has_window(const tribox_grid *grid, const tribox_window *window);

/* Whether a call may write a window: of a sound grid, in it, and of few enough cells. */
tribox_status tribox_grid_check_window(const tribox_grid *grid, const tribox_window *window);

/* All of the grid. */
tribox_window tribox_whole_window(const tribox_grid *grid);

/* The planes of a window of a sound grid; without a first cell those of the grid. */
tribox_planes tribox_planes_of(const tribox_grid *grid, const uint32_t first[3]);

/* Cells of a window, first to last: -1 stands for all below it, its size for all above. */
typedef struct tribox_cells {
    int64_t first, last;
} tribox_cells;

/* The closed cells of axis a, of `size` cells of the window, that the interval [least, most] of finite numbers touches. */
tribox_cells tribox_planes_cells(const tribox_planes *planes, int a, int64_t size, double least, double most);

#endif
