/*
 * voxels.h - one voxelization: what its rooms share.
 *
 * The bits of cells that certainly overlap are set by the kernel. Cells that rounding leaves open wait with their triangle until the
 * bits of others are written, as those set most of them; the rest are settled by their own boxes.
 */
#ifndef TRIBOX_VOXELS_H
#define TRIBOX_VOXELS_H

#include <string.h>

#include "bits.h"
#include "plan.h"

/* Open cells. */
enum { TRIBOX_WAITING = 128 };
typedef struct tribox_waiting {
    unsigned count;
    struct {
        float u[9]; /* the triangle: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2, as everywhere below */
        int32_t at[3];
    } cell[TRIBOX_WAITING];
} tribox_waiting;

/* One call: the layers that it writes. */
struct tribox_voxels {
    const tribox_grid *grid;
    tribox_plan plan;
    tribox_lattice lattice;
    int64_t first_layer, end_layer;
    size_t row_words;
    uint64_t *occupied; /* of the first layer */
    tribox_report counts;
    tribox_waiting waiting;
    tribox_strip strip[TRIBOX_SHAPES]; /* triangles that wait for their rows */
};

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

/* Cells first to last of row (j, k) wait with triangle u. */
void tribox_voxels_wait(tribox_voxels *v, const float u[9], int64_t first, int64_t last, int64_t j, int64_t k);

/* Settles the cells that wait, but those that are set by now: once more after the last triangle. */
void tribox_voxels_settle(tribox_voxels *v);

/* Triangle u, whose box touches these cells of the grid, `cells` from `base` on each axis, joins the strip of its shape. */
void tribox_voxels_join(tribox_voxels *v, const float u[9], const int64_t base[3], const int64_t cells[3], tribox_shape shape);

/* The rows of all strips that hold triangles. */
void tribox_voxels_set_strips(tribox_voxels *v);

/* One triangle, whatever its numbers: the planes of the grid decide which cells its box touches. */
void tribox_voxels_add(tribox_voxels *v, const float u[9]);

#endif
