/* cell_colours.h - the colours of the set cells of a grid, and of those alone: three bytes each, brick after brick. */
#ifndef CELL_COLOURS_H
#define CELL_COLOURS_H

#include <stddef.h>

#include "palette.h"

typedef struct coloured_brick {
    uint32_t at[3];
    uint64_t bits[8];
    uint64_t first; /* where its colours begin, which are in the order of its bits */
} coloured_brick;

typedef struct cell_colours {
    coloured_brick *bricks;
    size_t count;
    rgb *of;
    uint64_t cells;
    uint32_t *number; /* of each place of a brick: which one is there; UINT32_MAX for none */
    uint32_t size[3]; /* of the grid, in bricks */
    palette palette;  /* of them, for formats that have one; else empty */
} cell_colours;

/*
 * Takes bricks and colours, memory for free(), and finds their places in a grid of so many cells. False where there is no memory.
 */
bool cell_colours_place(cell_colours *c, const uint32_t cells[3]);

/* The colours of a brick that is there. */
const rgb *cell_colours_of_brick(const cell_colours *c, const uint32_t at[3]);

/* The colour of a set cell. */
rgb cell_colours_at(const cell_colours *c, const uint32_t cell[3]);

void cell_colours_free(cell_colours *c);

#endif
