/* grid_f64.h - whether a grid in double can be served, and which cells an interval touches. In the environment of environment.h. */
#ifndef TRIBOX_GRID_F64_H
#define TRIBOX_GRID_F64_H

#include <stdbool.h>

#include "grid_cells.h"
#include "planes.h"

/* Finite planes in strictly rising order, and cells on every axis. */
bool tribox_grid_f64_is_sound(const tribox_grid_f64 *grid);

/* The planes of a window of a sound grid; without a first cell those of the grid. */
tribox_planes tribox_planes_of(const tribox_grid_f64 *grid, const uint32_t first[3]);

/*
 * The closed cells of axis a, of `size` cells of the window, that the interval [least, most] of finite numbers touches. All below
 * the window are -1, all above it `size`.
 */
tribox_cells tribox_planes_cells(const tribox_planes *planes, int a, int64_t size, double least, double most);

#endif
