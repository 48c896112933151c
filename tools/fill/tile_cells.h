/* tile_cells.h - the words of a tile, or of a row of tiles, from bricks and into bricks. */
#ifndef TILE_CELLS_H
#define TILE_CELLS_H

#include "voxelize/tile_set.h"

/* Cells of a grid, a box of them, and how they lie in memory. */
typedef struct tile_cells {
    uint32_t first[3], size[3];
    const uint64_t *words;  /* of the row that has the first cell; NULL: all cells are set, and inside */
    const uint64_t *inside; /* which of them are inside, in rows as those; NULL where that is not asked, or all are set */
    size_t row_words;       /* from one row to the next; layers have size[1] rows */
    uint32_t shift;         /* the bit of the first cell in its word: a multiple of 8 */
} tile_cells;

/* The cells of tile t. */
tribox_window tile_cells_of(const tile_set *set, size_t t);

/* Where bricks are laid: words of a window that begins at multiples of 8 cells. */
typedef struct tile_words {
    tribox_window window;
    uint64_t *words;
} tile_words;

/* The surface of the tiles of records from .. to - 1, which are in the window, whose words it sets or clears. */
tribox_status tile_words_take(const tile_set *set, size_t from, size_t to, tile_room *room, tile_words *to_words,
                              tribox_report *report);

/* Takes bricks as a tribox_sink does, and which of the cells are inside, where that is asked. */
typedef struct filled_sink {
    int (*take)(void *data, const uint32_t at[3], const uint64_t bits[8], const uint64_t inside[8]); /* 0 to go on */
    void *data;
} filled_sink;

/*
 * Hands the bricks that have a set cell to the sink, by z, then y, then x, and adds them to *bricks; NULL to count them alone.
 * Returns what the sink did, 0 to go on.
 */
int tile_cells_cut(const tile_cells *cells, const filled_sink *sink, uint64_t *bricks);

#endif
