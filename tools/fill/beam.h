/*
 * beam.h - the tiles of a grid in rows along x, which follow each other in the order of tiles: what is filled at a time. Two ways
 * of filling have what is here in common.
 */
#ifndef BEAM_H
#define BEAM_H

#include "fill_kinds.h"
#include "tile_cells.h"

typedef struct beams {
    const tile_set *set;
    size_t tiles, count; /* tiles of each, and how many there are */
    size_t *first;       /* the first record of each, and after the last all */
    fill_cells cells;    /* that go on */
} beams;

/* False where there is no memory. */
bool beams_of(const tile_set *set, fill_cells cells, beams *b);
void beams_free(beams *b);

/* What was found in a beam; in sum in all. */
typedef struct beam_found {
    tribox_report report;
    uint64_t bricks;
    size_t inside, odd_rows;
} beam_found;

/* The cells of a beam that are set, tile by tile; words are the filling's own and stay until its next beam. */
typedef struct beam_solid {
    tile_cells *tiles; /* those that have any, in their order */
    size_t count;
} beam_solid;

/* The words of a filled surface become those of the cells inside. */
static inline void beam_keep_inside(uint64_t *surface, const uint64_t *solid, size_t words)
{
    for (size_t w = 0; w < words; w++)
        surface[w] = solid[w] & ~surface[w];
}

/* A way of filling. */
typedef struct beam_filling {
    const void *about;
    void *(*start)(const void *about); /* what a thread needs; NULL where there is no memory */
    tribox_status (*fill)(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found);
    void (*end)(void *room);
} beam_filling;

#endif
