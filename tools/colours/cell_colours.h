/* cell_colours.h - the colours of the set cells of a grid, and of those alone: three bytes each, brick after brick. */
#ifndef CELL_COLOURS_H
#define CELL_COLOURS_H

#include <stddef.h>

#include "rgb.h"

/* Colours as numbers of a palette, for formats that have one. */
enum { PALETTE_MAX = 255 };

typedef struct palette {
    rgb of[PALETTE_MAX];
    int count;
    unsigned char *place; /* in it, of each cube of 4 x 4 x 4 colours; NULL: they are as they are, in rising order */
} palette;

/*
 * Up to PALETTE_MAX colours stay as they are. More are divided by median cuts of their cubes: the box of cubes with the most cells
 * is cut in two of about as many across its longest side, until there are PALETTE_MAX; a box has the mean colour of its cells.
 * False where there is no memory. palette_free may follow in any case.
 */
bool palette_make(const rgb *colours, uint64_t cells, palette *p);

/* Which colour of the palette, from 0, stands for one of those that it was made of. */
int palette_find(const palette *p, rgb colour);

void palette_free(palette *p);

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
