/*
 * beam.h - the tiles of a grid in rows along x, which follow each other in the order of tiles: what is filled at a time. Two ways
 * of filling have what is here in common.
 */
#ifndef BEAM_H
#define BEAM_H

#include "console/progress.h"
#include "fill_tiles.h"

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
    void *(*start)(void *about); /* what a thread needs; NULL where there is no memory */
    tribox_status (*fill)(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found);
    void (*end)(void *room);
} beam_filling;

/* Parity of the crossings of rays along x: a window of whole rows at a time. */
extern const beam_filling beam_parity;

/* What the outside does not reach, in two passes over the tiles: the first, at the start, labels all. */
extern const beam_filling beam_outside;

#endif
