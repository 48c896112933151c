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
    void *(*start)(const void *about); /* what a thread needs; NULL where there is no memory */
    tribox_status (*fill)(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found);
    void (*end)(void *room);
} beam_filling;

/* Parity of the crossings of rays along x: a window of whole rows at a time. */
extern const beam_filling beam_parity;

/* What the outside does not reach, in two passes over the tiles: the first, at the start, labels all. */
extern const beam_filling beam_outside;

#endif
