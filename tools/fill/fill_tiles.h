/* fill_tiles.h - the cells of a surface and its inside, tile by tile, for grids whose words no memory holds. */
#ifndef FILL_TILES_H
#define FILL_TILES_H

#include "console/progress.h"
#include "voxelize/tile_set.h"

/* FILL_MIDDLES: parity of the middles alone, without the cells of the surface. */
typedef enum voxelize_fill { FILL_NONE, FILL_OUTSIDE, FILL_PARITY, FILL_MIDDLES } voxelize_fill;

/* The surface and its inside, as one or told apart; or the inside alone. */
typedef enum fill_cells { FILL_CELLS_ALL, FILL_CELLS_LABELLED, FILL_CELLS_INSIDE } fill_cells;

/* Takes bricks as a tribox_sink does, and which of the cells are inside, where that is asked. */
typedef struct filled_sink {
    int (*take)(void *data, const uint32_t at[3], const uint64_t bits[8], const uint64_t inside[8]); /* 0 to go on */
    void *data;
} filled_sink;

/* What was found in a beam; in sum in all. */
typedef struct beam_found {
    tribox_report report;
    uint64_t bricks;
    size_t inside, odd_rows;
} beam_found;

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

/* The words of a filled surface become those of the cells inside. */
static inline void fill_keep_inside(uint64_t *surface, const uint64_t *solid, size_t words)
{
    for (size_t w = 0; w < words; w++)
        surface[w] = solid[w] & ~surface[w];
}

#endif
