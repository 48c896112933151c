/* fill_tiles.h - the cells of a surface and its inside, tile by tile, for grids whose words no memory holds; by beams of tiles. */
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

typedef struct beams {
    const tile_set *set;
    size_t tiles, count; /* tiles of each, and how many there are */
    size_t *first;       /* the first record of each, and after the last all */
    fill_cells cells;    /* that go on */
} beams;

/* How many tiles there are along an axis, and the cells of tile t. */
uint32_t tiles_along(const tile_set *set, int a);
tribox_window tile_cells_of(const tile_set *set, size_t t);

/* The surface of the tiles of records from .. to - 1, which are in the window, whose words are set or cleared. */
tribox_status tile_words_take(const tile_set *set, size_t from, size_t to, tile_room *room, const tribox_window *window,
                              uint64_t *words, tribox_report *report);

/* A window of cells, and how they lie in memory. */
typedef struct tile_cells {
    tribox_window window;
    const uint64_t *words;  /* of the row that has the first cell; NULL: all cells are set, and inside */
    const uint64_t *inside; /* which of them are inside, in rows as those; NULL where that is not asked, or all are set */
    size_t row_words;       /* from one row to the next; layers have as many rows as the window */
    uint32_t shift;         /* the bit of the first cell in its word: a multiple of 8 */
} tile_cells;

/* The cells of a beam that are set, tile by tile; words are the filling's own and stay until its next beam. */
typedef struct beam_solid {
    tile_cells *tiles; /* those that have any, in their order */
    size_t count;
} beam_solid;

/* A way of filling. */
typedef struct beam_filling {
    /* What all threads need, for which `about` stands below; x: as of fill_tiles. In any case `close` follows. */
    tribox_status (*open)(const beams *b, const double x[2], unsigned threads, progress *bar, void **about);
    void (*close)(void *about);
    size_t room_bytes;                      /* what a thread needs, of zeros, and */
    bool (*start)(void *about, void *room); /* what else it takes; false where there is no memory */
    tribox_status (*fill)(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found);
    void (*end)(void *room); /* gives back what start took */
} beam_filling;

/* Parity of the crossings of rays along x: a window of whole rows at a time. */
extern const beam_filling beam_parity;

/* What the outside does not reach, in two passes over the tiles: the first, at the start, labels all. */
extern const beam_filling beam_outside;

#endif
