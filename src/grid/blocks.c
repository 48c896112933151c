/* blocks.c - blocks of cells are asked like cells, then parts of those that overlap, down to cells (PROOFS.md 7.10). */
#include "blocks.h"

#include "base/bits.h"
#include "pairs/settle.h"

/* A block is cut in four along each axis; there are no more than 4^16 cells along one. */
enum { PARTS = 4, LEVELS = 17 };

typedef struct block {
    int64_t base[3], cells[3], step[3]; /* the length of a part; the last one may be shorter */
    int64_t parts[3];
    uint64_t left; /* parts that overlap, and are still to be looked at */
} block;

/* Pair `to` of a batch: the triangle, and a block of cells. */
static void put_pair(const tribox_blocks *blocks, tribox_batch *batch, unsigned to, const double u[9], const int64_t base[3],
                     const int64_t cells[3])
{
    for (int n = 0; n < 9; n++)
        batch->number[n][to] = u[n];
    for (int a = 0; a < 3; a++) {
        batch->number[9 + a][to] = blocks->plane(blocks->lattice, a, base[a]);
        batch->number[12 + a][to] = blocks->plane(blocks->lattice, a, base[a] + cells[a]);
    }
}

/* Part n: its cells. */
static void part_at(const block *b, unsigned n, int64_t base[3], int64_t cells[3])
{
    const int64_t at[3] = {n % b->parts[0], n / b->parts[0] % b->parts[1], n / b->parts[0] / b->parts[1]};
    for (int a = 0; a < 3; a++) {
        const int64_t left = b->cells[a] - at[a] * b->step[a];
        base[a] = b->base[a] + at[a] * b->step[a];
        cells[a] = b->step[a] < left ? b->step[a] : left;
    }
}

/* Few cells are parts themselves. */
static bool are_few(const int64_t cells[3])
{
    return cells[0] <= TRIBOX_BATCH && cells[1] <= TRIBOX_BATCH && cells[2] <= TRIBOX_BATCH &&
           cells[0] * cells[1] * cells[2] <= TRIBOX_BATCH;
}

/* These cells, cut, and the parts that overlap the triangle. Returns how many were asked. */
static unsigned ask_parts(const tribox_blocks *blocks, const double u[9], const int64_t base[3], const int64_t cells[3],
                          tribox_batch *batch, block *b)
{
    const bool is_last = are_few(cells);
    for (int a = 0; a < 3; a++) {
        b->base[a] = base[a];
        b->cells[a] = cells[a];
        b->step[a] = is_last ? 1 : (cells[a] + PARTS - 1) / PARTS;
        b->parts[a] = (cells[a] + b->step[a] - 1) / b->step[a];
    }
    const unsigned count = (unsigned)(b->parts[0] * b->parts[1] * b->parts[2]);
    for (unsigned n = 0; n < count; n++) {
        int64_t part_base[3], part_cells[3];
        part_at(b, n, part_base, part_cells);
        put_pair(blocks, batch, n, u, part_base, part_cells);
    }
    b->left = tribox_settle_batch(batch, count, blocks->plan).overlapping;
    return count;
}

size_t tribox_blocks_ask(const tribox_blocks *blocks, const double u[9], const int64_t base[3], const int64_t cells[3])
{
    tribox_batch batch;
    block level[LEVELS];
    int at = 0;
    size_t asked = ask_parts(blocks, u, base, cells, &batch, &level[0]);
    while (at >= 0) {
        int64_t part_base[3], part_cells[3];
        block *const b = &level[at];
        if (!b->left) {
            at--;
            continue;
        }
        part_at(b, tribox_lowest_bit(b->left), part_base, part_cells);
        b->left &= b->left - 1;
        if (part_cells[0] == 1 && part_cells[1] == 1 && part_cells[2] == 1)
            blocks->take(blocks->taker, part_base);
        else
            asked += ask_parts(blocks, u, part_base, part_cells, &batch, &level[++at]);
    }
    return asked;
}
