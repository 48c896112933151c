/* palette.h - colours as numbers of a palette, for formats that have one. */
#ifndef PALETTE_H
#define PALETTE_H

#include "rgb.h"

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

#endif
