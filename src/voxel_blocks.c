/*
 * voxel_blocks.c - triangles of doubles for which no limits hold: blocks of cells are asked like cells, then parts of those that
 * overlap, down to cells (PROOFS.md 7.10). Slow, but right for whatever numbers.
 */
#include "voxels.h"

#include "settle.h"

/* A block is cut in four along each axis; a grid is no longer than 4^16 cells. */
enum { PARTS = 4, LEVELS = 17 };

typedef struct block {
    int64_t base[3], cells[3], step[3]; /* the length of a part; the last one may be shorter */
    int64_t parts[3];
    uint64_t left; /* parts that overlap, and are still to be looked at */
} block;

/* Pair `to` of a batch: the triangle, and a block of cells. */
static void put_pair(tribox_batch *batch, unsigned to, const tribox_triangle *triangle, const tribox_planes *planes,
                     const int64_t base[3], const int64_t cells[3])
{
    for (int n = 0; n < 9; n++)
        batch->number[n][to] = triangle->u[n];
    for (int a = 0; a < 3; a++) {
        batch->number[9 + a][to] = tribox_plane_at(planes, a, base[a]);
        batch->number[12 + a][to] = tribox_plane_at(planes, a, base[a] + cells[a]);
    }
}

/* Part n: its cells. */
static void part_at(const block *b, unsigned n, int64_t base[3], int64_t cells[3])
{
    const int64_t at[3] = {n % b->parts[0], n / b->parts[0] % b->parts[1], n / b->parts[0] / b->parts[1]};
    for (int a = 0; a < 3; a++) {
        base[a] = b->base[a] + at[a] * b->step[a];
        cells[a] = tribox_least(b->step[a], b->base[a] + b->cells[a] - base[a]);
    }
}

/* These cells, cut, and the parts that overlap the triangle. */
static void ask_parts(tribox_voxels *v, const tribox_triangle *triangle, const int64_t base[3], const int64_t cells[3],
                      tribox_batch *batch, block *b)
{
    for (int a = 0; a < 3; a++) {
        b->base[a] = base[a];
        b->cells[a] = cells[a];
        b->step[a] = (cells[a] + PARTS - 1) / PARTS;
        b->parts[a] = (cells[a] + b->step[a] - 1) / b->step[a];
    }
    const unsigned count = (unsigned)(b->parts[0] * b->parts[1] * b->parts[2]);
    for (unsigned n = 0; n < count; n++) {
        int64_t part_base[3], part_cells[3];
        part_at(b, n, part_base, part_cells);
        put_pair(batch, n, triangle, &v->planes, part_base, part_cells);
    }
    v->counts.undecided += count;
    b->left = tribox_settle_batch(batch, count, &v->plan).overlapping;
}

static void set_cell(tribox_voxels *v, const int64_t at[3])
{
    const int64_t row = (at[2] - v->first_layer) * v->size[1] + at[1];
    v->counts.overlapping += tribox_set_cells(v->occupied + row * (int64_t)v->row_words, at[0], at[0]);
}

void tribox_voxels_ask(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range)
{
    tribox_batch batch;
    block level[LEVELS];
    int at = 0;
    ask_parts(v, triangle, range->base, range->cells, &batch, &level[0]);
    while (at >= 0) {
        int64_t base[3], cells[3];
        block *const b = &level[at];
        if (!b->left) {
            at--;
            continue;
        }
        part_at(b, tribox_lowest_bit(b->left), base, cells);
        b->left &= b->left - 1;
        if (cells[0] == 1 && cells[1] == 1 && cells[2] == 1)
            set_cell(v, base);
        else
            ask_parts(v, triangle, base, cells, &batch, &level[++at]);
    }
}
