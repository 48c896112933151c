/* fill_tiles.h - the cells of a surface and its inside, tile by tile, for grids whose words no memory holds. */
#ifndef FILL_TILES_H
#define FILL_TILES_H

#include "beam.h"
#include "console/progress.h"

/*
 * Hands the bricks of a filled grid to the sink, in the order of tribox_bricks, one at a time, from any of the threads.
 *
 * x: the bounds of the mesh along x, to fill by parity, for which the set has the mesh itself; NULL to fill what the outside does
 *   not reach. With a set without records parity is that of the middles alone.
 * cells: which of them reach the sink: all, or those inside.
 * sink: NULL to count alone.
 *
 * Returns what the library does, or MESSAGE_NO_MEMORY.
 */
tribox_status fill_tiles(const tile_set *set, const double x[2], fill_cells cells, unsigned threads, const filled_sink *sink,
                         progress *bar, beam_found *found);

#endif
