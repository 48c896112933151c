/*
 * fill_row.h - one row of cells along x: the outside comes in from rows next to it and its ends, and spreads through free cells.
 * `solid` has a bit for each cell that is not reached, and none past the last cell; `last` has those of the last word's cells.
 *
 * Loops over all words are free of branches, so that compilers make vectors of them; few rows need more.
 */
#ifndef TRIBOX_FILL_ROW_H
#define TRIBOX_FILL_ROW_H

#include <stdbool.h>

#include "fill.h"

/* The seeds, and all bits of `is_free` above them in their runs: a run turns to zeros as the carry goes through it. */
static inline uint64_t tribox_spread_up(uint64_t seeds, uint64_t is_free) { return (is_free & ~(is_free + seeds)) | seeds; }

static inline uint64_t tribox_spread_down(uint64_t seeds, uint64_t is_free)
{
    for (int step = 1; step < 64; step *= 2) {
        seeds |= is_free & seeds >> step;
        is_free &= is_free >> step;
    }
    return seeds;
}

/* A row that all is next to the outside: its free cells are reached. */
static inline void tribox_row_open(size_t words, uint64_t last, const uint64_t *occupied, uint64_t *solid)
{
    for (size_t w = 0; w < words; w++)
        solid[w] = occupied[w];
    solid[words - 1] &= last;
}

/*
 * A row for the first time: from two rows next to it, and upwards within words. Whether free cells are left that are not reached.
 * Past the last cell all is reached, as it is in the rows next to it.
 */
static inline bool tribox_row_start(size_t words, uint64_t last, const uint64_t *restrict occupied, const uint64_t *restrict below,
                                    const uint64_t *restrict behind, uint64_t *restrict solid)
{
    uint64_t left = 0;
    for (size_t w = 0; w < words; w++) {
        const uint64_t is_free = ~occupied[w];
        solid[w] = ~tribox_spread_up(is_free & ~(below[w] & behind[w]), is_free);
        left |= solid[w] & is_free;
    }
    solid[words - 1] &= last;
    return left;
}

/* The same for a row that was started, and three or four rows: one may come twice, but not the row itself. */
static inline void tribox_row_take(size_t words, const uint64_t *restrict occupied, const uint64_t *a, const uint64_t *b,
                                   const uint64_t *c, const uint64_t *d, uint64_t *restrict solid)
{
    for (size_t w = 0; w < words; w++) {
        const uint64_t left = solid[w] & ~occupied[w];
        solid[w] &= ~tribox_spread_up(left & ~(a[w] & b[w] & c[w] & d[w]), left);
    }
}

/* Whether a cell that is free and not reached lies next to a reached one, within words below it. Ends lie next to the outside. */
static inline bool tribox_row_is_open(size_t words, uint64_t last, const uint64_t *occupied, const uint64_t *solid)
{
    const uint64_t end = last & ~(last >> 1);
    uint64_t reachable = (solid[0] & ~occupied[0] & 1) | (solid[words - 1] & ~occupied[words - 1] & end);
    for (size_t w = 0; w + 1 < words; w++) {
        const uint64_t low = ~solid[w], high = ~solid[w + 1];
        reachable |= solid[w] & ~occupied[w] & (low >> 1 | high << 63);
        reachable |= solid[w + 1] & ~occupied[w + 1] & low >> 63;
    }
    return reachable | (solid[words - 1] & ~occupied[words - 1] & ~solid[words - 1] >> 1);
}

/* From word to word, and downwards within words. */
static inline void tribox_row_close(size_t words, uint64_t last, const uint64_t *occupied, uint64_t *solid)
{
    uint64_t beyond = 1; /* reached: the cell next to the word */
    for (size_t w = 0; w < words; w++) {
        const uint64_t left = solid[w] & ~occupied[w];
        if (left & beyond)
            solid[w] &= ~tribox_spread_up(left & beyond, left);
        beyond = ~solid[w] >> 63;
    }
    beyond = last & ~(last >> 1);
    for (size_t w = words; w-- > 0;) {
        const uint64_t left = solid[w] & ~occupied[w], seeds = left & (~solid[w] >> 1 | beyond);
        if (seeds)
            solid[w] &= ~tribox_spread_down(seeds, left);
        beyond = ~solid[w] << 63;
    }
}

/* Whether the row has a free cell next to a reached one of another, and how many free cells are not reached. */
static inline bool tribox_row_is_next_to(size_t words, const uint64_t *other, const uint64_t *occupied, const uint64_t *solid)
{
    uint64_t is = 0;
    for (size_t w = 0; w < words; w++)
        is |= ~other[w] & solid[w] & ~occupied[w];
    return is;
}

static inline size_t tribox_row_left(size_t words, const uint64_t *occupied, const uint64_t *solid)
{
    size_t left = 0;
    for (size_t w = 0; w < words; w++)
        left += tribox_count_most(solid[w] & ~occupied[w]);
    return left;
}

#endif
