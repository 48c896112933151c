/* voxel_rows.h - bits of cells, row by row: those that certainly overlap are set, open ones wait for their batch. */
#ifndef TRIBOX_VOXEL_ROWS_H
#define TRIBOX_VOXEL_ROWS_H

#include "bits.h"
#include "plan.h"

/* The layers that one call writes, and its open cells. */
typedef struct tribox_voxels {
    const tribox_grid *grid;
    tribox_plan plan;
    int64_t first_layer, end_layer;
    size_t row_words;
    uint64_t *occupied; /* of the first layer */
    tribox_report counts;
    unsigned open; /* cells in the batch, each with the triangle that may overlap it */
    tribox_batch batch;
    struct {
        uint64_t *word, bit;
    } cell[TRIBOX_BATCH];
} tribox_voxels;

static inline int64_t tribox_least(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t tribox_greatest(int64_t a, int64_t b) { return a > b ? a : b; }

/* Sets cells first to last of a row, a word at a time. Returns how many were not set before. */
static inline size_t tribox_set_cells(uint64_t *row, int64_t first, int64_t last)
{
    const uint64_t full = ~UINT64_C(0), from = full << first % 64, to = full >> (63 - last % 64);
    uint64_t *word = row + first / 64, *const end = row + last / 64;
    if (word == end)
        return tribox_set_bits(word, from & to);
    size_t set = tribox_set_bits(word, from);
    while (++word < end)
        if (*word != full)
            set += tribox_set_bits(word, full);
    return set + tribox_set_bits(word, to);
}

/* Sets the cells of triangle t of a strip, row by row within its limits; open ones join the batch. */
void tribox_voxels_set_rows(tribox_voxels *v, const tribox_strip *strip, unsigned t, tribox_shape shape,
                            const tribox_limits *limits);

/*
 * Cells first to last of row (j, k) join the batch with triangle u, in the order x_0 x_1 x_2 y_0 .. z_2, except those already set.
 */
void tribox_voxels_add_open(tribox_voxels *v, const float u[9], int64_t first, int64_t last, int64_t j, int64_t k);

/* Settles the batch and empties it: once more after the last triangle. */
void tribox_voxels_settle_open(tribox_voxels *v);

#endif
