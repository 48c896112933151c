/*
 * voxelizing.h - one voxelization: its window, its sinks, its counts, and what is done with them.
 *
 * The bits of cells that certainly overlap are set by the kernel. Cells that rounding leaves undecided wait with their triangle
 * until the bits of others are written, as those set most of them; the rest are settled by their own boxes.
 */
#ifndef TRIBOX_VOXELIZING_H
#define TRIBOX_VOXELIZING_H

#include <string.h>

#include "grid/cell_bits.h"
#include "plan.h"
#include "sinks.h"
#include "window.h"

struct tribox_voxels {
    tribox_plan plan;
    tribox_voxel_window window;
    tribox_voxel_sinks sinks;
    tribox_report counts;
};

static inline int64_t tribox_least(int64_t a, int64_t b) { return a < b ? a : b; }
static inline int64_t tribox_greatest(int64_t a, int64_t b) { return a > b ? a : b; }

/*
 * A window of a sound grid as a grid of its own; the plan is made, and the triangles have their vertices. In the environment of
 * environment.h: begin, put triangles, end. Bits and counts are whole then. Of doubles FAST becomes CONSERVATIVE.
 */
void tribox_voxels_begin(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                         uint64_t *occupied);
void tribox_voxels_end(tribox_voxels *v);

/* Begins a window of which whole layers have the cells that they have in the grid, at every accuracy (PROOFS.md 7.9). */
void tribox_voxels_begin_window(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid,
                                const tribox_window *window, uint64_t *occupied);

/* Right after the beginning: only these layers are written, the first of which is now that of `occupied`. */
void tribox_voxels_limit_layers(tribox_voxels *v, uint32_t first, uint32_t layers);

/*
 * Before the first triangle: also the lowest number of a triangle for each cell that is set, `first` being that of triangle 0.
 * `ids` are those of the layers that are written.
 */
void tribox_voxels_ask_ids(tribox_voxels *v, uint32_t *ids, uint32_t first);

/* The id of a triangle with this number (tribox_triangle). */
static inline uint32_t tribox_voxels_id(const tribox_voxels *v, int32_t number)
{
    return v->sinks.ids.first + (uint32_t)v->window.first_triangle + (uint32_t)number;
}

/* Likewise, in place of bits: each pair of a cell and a triangle that overlaps it. */
void tribox_voxels_ask_pairs(tribox_voxels *v, const tribox_pair_sink *pairs);

/* Lists the cells of a word with a triangle. */
static inline void tribox_voxels_pair(tribox_voxels *v, size_t word, uint64_t bits, int32_t number)
{
    tribox_writes *const w = &v->sinks.writes;
    if (w->count > TRIBOX_WRITES)
        v->sinks.handlers->write(v);
    for (uint32_t half = 2 * (uint32_t)word; bits; half++, bits >>= 32) {
        w->half[w->count] = (int32_t)half;
        w->bits[w->count] = (int32_t)(uint32_t)bits;
        w->number[w->count] = number;
        w->count += (uint32_t)bits != 0;
    }
}

/* Cells `first` to last of a row, none where that is before the first, counted from the first bit of word `row`. */
static inline void tribox_voxels_pair_row(tribox_voxels *v, size_t row, int64_t first, int64_t last, int32_t number)
{
    const uint64_t full = ~UINT64_C(0);
    for (int64_t at = first, end; at <= last; at = end) {
        end = (at / 64 + 1) * 64;
        tribox_voxels_pair(v, row + (size_t)(at / 64), full << at % 64 & full >> (end > last ? 63 - last % 64 : 0), number);
    }
}

/*
 * Some of the triangles, as streams of which whole packets can be read: floats, or doubles less tribox_voxels_origin, with the
 * number of each where they have any.
 */
void tribox_voxels_put(tribox_voxels *v, const tribox_soup *streams, const int32_t *number);
static inline const double *tribox_voxels_origin(const tribox_voxels *v) { return v->window.lattice.origin; }

void tribox_voxels_put_all(tribox_voxels *v, const tribox_triangles *triangles);

/* Nothing waits and nothing is counted: before the first triangle, once sizes and layers are known. */
void tribox_voxels_empty_sinks(tribox_voxels *v, uint64_t *occupied);

/* All cells wait with the triangle, where it is finite. */
void tribox_voxels_wait_everywhere(tribox_voxels *v, const tribox_triangle *triangle);

/* Settles the cells that wait, but those that are set by now: once more after the last triangle. */
void tribox_voxels_settle_waiting(tribox_voxels *v);

/* A triangle that touches these cells of the grid: a line is set, another joins the strip of its shape. */
void tribox_voxels_take_triangle(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range);

/* The rows of all strips that hold triangles. */
void tribox_voxels_set_strips(tribox_voxels *v);

/* One triangle, whatever its numbers: the planes of the grid decide which cells its box touches. */
void tribox_voxels_add_triangle(tribox_voxels *v, const tribox_triangle *triangle);

/* A triangle whose cells are found by no limits, but by asking blocks of them, and blocks of these (PROOFS.md 7.10). */
void tribox_voxels_ask_blocks(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range);

/* Cells first to last of row (j, k) wait with their triangle. */
static inline void tribox_voxels_wait_for_row(tribox_voxels *v, const tribox_triangle *triangle, int64_t first, int64_t last,
                                              int64_t j, int64_t k)
{
    tribox_waiting *const w = &v->sinks.waiting;
    for (; first <= last; first += 32) {
        if (w->count == TRIBOX_WAITING)
            v->sinks.handlers->settle_waiting(v);
        for (int n = 0; n < 9 && !v->window.doubles; n++)
            w->u[n][w->count] = (float)triangle->u[n];
        w->number[w->count] = triangle->number;
        w->at[0][w->count] = (int32_t)(uint32_t)first;
        w->at[1][w->count] = (int32_t)(uint32_t)j;
        w->at[2][w->count] = (int32_t)(uint32_t)k;
        w->bits[w->count++] = (int32_t)(~UINT32_C(0) >> (last - first < 31 ? 31 - (last - first) : 0));
    }
}

#endif
