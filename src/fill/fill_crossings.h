/* fill_crossings.h - triangles and the rays along x through the middles of rows of cells: where they cross. */
#ifndef TRIBOX_FILL_CROSSINGS_H
#define TRIBOX_FILL_CROSSINGS_H

#include "fill.h"
#include "fill_middles.h"
#include "kernel.h"

/* Bits to be turned, so that many words can be fetched at a time. */
enum { TRIBOX_TURNS = 256, TRIBOX_TURNS_AHEAD = 16 };
typedef struct tribox_turns {
    uint64_t *word[TRIBOX_TURNS + TRIBOX_TURNS_AHEAD], bit[TRIBOX_TURNS];
    unsigned count;
} tribox_turns;

/* What the kernel leaves to exact signs, handed in: u[j][a] is axis a of vertex j. */
typedef struct tribox_crossing_handlers {
    void (*add_row)(tribox_crossings *c, double u[3][3], int64_t j, int64_t k); /* one row of cells */
    void (*add_doubtful)(tribox_crossings *c, double u[3][3]); /* all: whether it has an area or is finite is in doubt */
} tribox_crossing_handlers;

/* Where the cells that hold a crossing are set, for which x, y and z stand for axes `along` and those after it, cyclically. */
typedef struct tribox_crossed_cells {
    uint64_t *occupied; /* NULL: crossings turn bits */
    size_t row_words;
    uint32_t size[3]; /* of the cells as they are */
    int along;
    size_t set; /* cells that were clear before */
} tribox_crossed_cells;

/* The rows that crossings are written to, or their cells. */
struct tribox_crossings {
    const tribox_crossing_handlers *handlers;
    const tribox_kernel *kernel;
    tribox_middles middles;
    tribox_rows rows;
    uint64_t *solid;  /* in the first cell whose middle lies past a crossing, the bit is turned; */
    uint64_t *beyond; /* if there is none, the bit of the row */
    tribox_crossed_cells cells;
    tribox_turns turns;
};

/* Triangles at a time, as everywhere: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2. */
enum { TRIBOX_SEEN_ALONG = 64 };
struct tribox_seen_along {
    double number[9][TRIBOX_SEEN_ALONG];
};

/* Turns a bit for each crossing of the first `count` triangles. Nothing of those that are not finite. */
void tribox_crossings_add(tribox_crossings *c, const tribox_seen_along *seen, size_t count);

/* The same for one triangle u[j][a], axis a of vertex j, by exact signs alone. */
void tribox_crossings_exactly(tribox_crossings *c, double u[3][3]);

/* The same for a triangle whose area, or whether it is finite, is in doubt. */
void tribox_crossings_doubtful(tribox_crossings *c, double u[3][3]);

/* The same for one row of cells. */
void tribox_crossings_row(tribox_crossings *c, double u[3][3], int64_t j, int64_t k);

/* Those two. */
extern const tribox_crossing_handlers tribox_exact_crossings;

/* Turns what is listed, or sets it. */
static inline void tribox_crossings_finish(tribox_crossings *c)
{
    tribox_turns *const turns = &c->turns;
    const uint64_t kept = c->cells.occupied ? ~UINT64_C(0) : 0;
    for (unsigned n = 0; n < TRIBOX_TURNS_AHEAD; n++)
        turns->word[turns->count + n] = c->beyond;
    for (unsigned n = 0; n < turns->count; n++) {
        const uint64_t word = *turns->word[n], bit = turns->bit[n];
        tribox_will_write(turns->word[n + TRIBOX_TURNS_AHEAD]);
        c->cells.set += !(word & bit);
        *turns->word[n] = (word ^ bit) | (bit & kept);
    }
    turns->count = 0;
}

/* Lists the cell that holds a crossing, if it is there. */
static inline void tribox_crossings_set(tribox_crossings *c, int64_t j, int64_t k, int64_t cell)
{
    const tribox_crossed_cells *const cells = &c->cells;
    tribox_turns *const turns = &c->turns;
    size_t at[3];
    if (cell < 0 || cell >= c->middles.size[0])
        return;
    at[cells->along] = (size_t)cell;
    at[(cells->along + 1) % 3] = (size_t)j;
    at[(cells->along + 2) % 3] = (size_t)k;
    turns->word[turns->count] = cells->occupied + (at[2] * cells->size[1] + at[1]) * cells->row_words + at[0] / 64;
    turns->bit[turns->count++] = UINT64_C(1) << at[0] % 64;
    if (turns->count == TRIBOX_TURNS)
        tribox_crossings_finish(c);
}

/* Lists the bit of a cell, 0 to size, of row (j, k): without a branch, as that cannot be foreseen. */
static inline void tribox_crossings_turn(tribox_crossings *c, int64_t j, int64_t k, int64_t cell)
{
    if (c->cells.occupied) {
        tribox_crossings_set(c, j, k, cell);
        return;
    }
    const size_t row = (size_t)k * c->middles.size[1] + (size_t)j;
    const bool is_within = cell < c->middles.size[0];
    const size_t bit = is_within ? (size_t)cell : row;
    tribox_turns *const turns = &c->turns;
    turns->word[turns->count] = (is_within ? c->solid + row * c->rows.words : c->beyond) + bit / 64;
    turns->bit[turns->count++] = UINT64_C(1) << bit % 64;
    if (turns->count == TRIBOX_TURNS)
        tribox_crossings_finish(c);
}

#endif
