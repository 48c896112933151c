/* blocks.h - which cells of a lattice a triangle overlaps, by asking blocks of them, and blocks of these. */
#ifndef TRIBOX_BLOCKS_H
#define TRIBOX_BLOCKS_H

#include "plan.h"

/* Increasing planes on every axis, and a callback for each overlapping cell between them. */
typedef struct tribox_blocks {
    const tribox_plan *plan; /* whose accuracy and axes are asked */
    double (*plane)(const void *lattice, int a, int64_t p);
    const void *lattice;
    void (*take)(void *taker, const int64_t at[3]);
    void *taker;
} tribox_blocks;

/*
 * Asks about cells base[a] .. base[a] + cells[a] - 1 of each axis, one at least and 4^16 at most. The triangle is x_0 x_1 x_2 y_0
 * y_1 y_2 z_0 z_1 z_2. Returns how many pairs were asked.
 */
size_t tribox_blocks_ask(const tribox_blocks *blocks, const double u[9], const int64_t base[3], const int64_t cells[3]);

#endif
