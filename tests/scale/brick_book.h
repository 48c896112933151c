/* brick_book.h - a sink that checks what it is handed, and keeps the bits as those of a dense grid. */
#ifndef TRIBOX_TESTS_BRICK_BOOK_H
#define TRIBOX_TESTS_BRICK_BOOK_H

#include "tile_case.h"

typedef struct brick_book {
    const uint32_t *size; /* of the grid */
    uint32_t tile;
    uint64_t *occupied;   /* NULL to keep nothing */
    size_t bricks, cells; /* handed on by now */
    size_t most;          /* bricks after which it ends the call */
    uint64_t last[4];     /* the place of the last brick: tile, z, y, x */
    unsigned environment; /* in which it has to run */
} brick_book;

/* Without an end, in the environment of now. */
brick_book brick_book_open(const tile_case *c, uint64_t *occupied);

/*
 * The sink. Fails the test where a brick is empty, has a cell outside the grid, or does not come after the last one by the number
 * of its tile, then z, y and x.
 */
int brick_book_take(void *book, const uint32_t at[3], const uint64_t bits[8]);

#endif
