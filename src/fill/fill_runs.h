/* fill_runs.h - runs of free cells along x, sets of them that are joined, and where scratch has what is known of them. */
#ifndef TRIBOX_FILL_RUNS_H
#define TRIBOX_FILL_RUNS_H

#include "fill.h"

/* The free cells from .. end - 1 of a row. */
typedef struct tribox_run {
    uint32_t from, end;
} tribox_run;

/* A row of `size` cells; bits past its last are ignored. */
typedef struct tribox_run_row {
    const uint64_t *occupied;
    uint32_t size;
} tribox_run_row;

/* Occupied cells, and all that are past the last, of word w, from cell `at` on. */
static inline uint64_t tribox_run_walls(const tribox_run_row *row, uint32_t w)
{
    const uint32_t left = row->size - 64 * w;
    return left < 64 ? row->occupied[w] | ~UINT64_C(0) << left : row->occupied[w];
}

/* The first run from cell `at` on, which may cut it. False if there is none. */
static inline bool tribox_run_next(const tribox_run_row *row, uint32_t at, tribox_run *run)
{
    const uint32_t words = (uint32_t)tribox_words_of(row->size);
    uint32_t w = at / 64;
    if (at >= row->size)
        return false;
    uint64_t bits = ~tribox_run_walls(row, w) & ~UINT64_C(0) << at % 64;
    while (!bits && ++w < words)
        bits = ~tribox_run_walls(row, w);
    if (!bits)
        return false;
    run->from = 64 * w + tribox_lowest_bit(bits);
    bits = tribox_run_walls(row, w) & ~UINT64_C(0) << run->from % 64;
    while (!bits && ++w < words)
        bits = tribox_run_walls(row, w);
    run->end = bits ? 64 * w + tribox_lowest_bit(bits) : row->size;
    return true;
}

/* The least of the set that `label` is in: no parent is above its children. */
static inline uint32_t tribox_set_root(uint32_t *parents, uint32_t label)
{
    while (parents[label] != label) {
        parents[label] = parents[parents[label]];
        label = parents[label];
    }
    return label;
}

static inline void tribox_set_join(uint32_t *parents, uint32_t a, uint32_t b)
{
    const uint32_t root_a = tribox_set_root(parents, a), root_b = tribox_set_root(parents, b);
    if (root_a < root_b)
        parents[root_b] = root_a;
    else
        parents[root_a] = root_b;
}

/* Runs of a part of a grid, numbered as they come: row after row, along x. */
typedef struct tribox_runs {
    uint32_t size[3];
    tribox_rows rows;
    size_t most; /* runs of a row */
    const uint64_t *occupied;
    uint32_t *first;      /* the first run of each row, and after the last row their number */
    uint32_t *parents;    /* of runs while they are joined; then their labels */
    tribox_run *spans[2]; /* of two layers, the even and the odd one */
} tribox_runs;

/* Whether runs can be numbered with a bit to spare, and bytes addressed. */
bool tribox_runs_are_served(const uint32_t size[3]);

/* Of a size that is served: at most, with what aligns them. */
size_t tribox_runs_bytes(const uint32_t size[3]);

tribox_runs tribox_runs_in(const uint32_t size[3], const uint64_t *occupied, void *scratch);

static inline tribox_run_row tribox_run_row_of(const tribox_runs *r, size_t row)
{
    return (tribox_run_row){r->occupied + row * r->rows.words, r->size[0]};
}

#endif
