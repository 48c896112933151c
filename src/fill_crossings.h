/* fill_crossings.h - triangles and the rays along x through the middles of rows of cells: where they cross. */
#ifndef TRIBOX_FILL_CROSSINGS_H
#define TRIBOX_FILL_CROSSINGS_H

#include "fill.h"
#include "fill_middles.h"

/* The rows that crossings are written to. */
typedef struct tribox_crossings {
    tribox_middles middles;
    tribox_rows rows;
    uint64_t *solid;  /* in the first cell whose middle lies past a crossing, the bit is turned; */
    uint64_t *beyond; /* if there is none, the bit of the row */
} tribox_crossings;

/* Triangles at a time, as everywhere: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2. */
enum { TRIBOX_SEEN_ALONG = 64 };
typedef struct tribox_seen_along {
    double number[9][TRIBOX_SEEN_ALONG];
} tribox_seen_along;

/* Turns a bit for each crossing of the first `count` triangles. Nothing of those that are not finite. */
void tribox_crossings_add(const tribox_crossings *c, const tribox_seen_along *seen, size_t count);

/* The same for one triangle u[j][a], axis a of vertex j, by exact signs alone. */
void tribox_crossings_exactly(const tribox_crossings *c, double u[3][3]);

/* A row by exact signs, for a triangle that a cell of the row is beside. */
void tribox_crossings_row(const tribox_crossings *c, double u[3][3], int64_t j, int64_t k);

/* Turns the bit of a cell, 0 to size, of row (j, k). */
static inline void tribox_crossings_turn(const tribox_crossings *c, int64_t j, int64_t k, int64_t cell)
{
    const size_t row = (size_t)k * c->middles.size[1] + (size_t)j;
    if (cell < c->middles.size[0])
        c->solid[row * c->rows.words + (size_t)(cell / 64)] ^= UINT64_C(1) << cell % 64;
    else
        c->beyond[row / 64] ^= UINT64_C(1) << row % 64;
}

#endif
