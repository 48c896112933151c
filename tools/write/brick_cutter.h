/* brick_cutter.h - bricks of 8 x 8 x 8 cells out of the words of a grid, and into them. */
#ifndef BRICK_CUTTER_H
#define BRICK_CUTTER_H

#include "console/progress.h"
#include "voxels.h"

/* Takes a brick as a tribox_sink does, but returns an exit_code. */
typedef int brick_taker(void *data, const uint32_t at[3], const uint64_t bits[8]);

/*
 * Hands over each brick of the voxels that has a set cell, until one is not taken: by z, then y, then x, and with tiles tile after
 * tile, as tribox_bricks does. tile: cells along a side, a multiple of 64; 0: no tiles. Returns an exit_code.
 */
int bricks_cut(const voxels *v, uint32_t tile, brick_taker *take, void *data, progress *bar);

/* The cells of a brick that are inside, of voxels with labels. */
void bricks_inside(const voxels *v, const uint32_t at[3], uint64_t inside[8]);

/* Sets the cells of a brick that lies in the grid, in the words of all its layers. */
void bricks_lay(const tribox_grid *grid, uint64_t *words, const uint32_t at[3], const uint64_t bits[8]);

#endif
