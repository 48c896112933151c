/* voxel_waiting.c - open cells: they wait, and are settled by their own boxes. */
#include "voxels.h"

#include "grid_cells.h"
#include "settle.h"

/* The word of a cell, and its bit there. */
typedef struct cell_bit {
    uint64_t *word, bit;
} cell_bit;

void tribox_voxels_wait(tribox_voxels *v, const float u[9], int64_t first, int64_t last, int64_t j, int64_t k)
{
    tribox_waiting *const w = &v->waiting;
    for (; first <= last; first += 32) {
        if (w->count == TRIBOX_WAITING)
            tribox_voxels_settle(v);
        for (int n = 0; n < 9; n++)
            w->u[n][w->count] = u[n];
        w->at[0][w->count] = (int32_t)first;
        w->at[1][w->count] = (int32_t)j;
        w->at[2][w->count] = (int32_t)k;
        w->bits[w->count++] = (int32_t)(~UINT32_C(0) >> (last - first < 31 ? 31 - (last - first) : 0));
    }
}

static void settle_batch(tribox_voxels *v, tribox_batch *batch, unsigned count, const cell_bit *cell)
{
    v->counts.undecided += count;
    for (uint64_t left = tribox_settle_batch(batch, count, &v->plan).overlapping; left; left &= left - 1) {
        const unsigned i = tribox_lowest_bit(left);
        v->counts.overlapping += tribox_set_bits(cell[i].word, cell[i].bit);
    }
}

/* The cells that wait, one by one. Returns how many are left in the batch. */
static unsigned add_row(tribox_voxels *v, unsigned row, tribox_batch *batch, unsigned count, cell_bit *cell)
{
    const tribox_waiting *const w = &v->waiting;
    const int32_t j = w->at[1][row], k = w->at[2][row];
    uint64_t *const words = v->occupied + ((k - v->first_layer) * (int64_t)v->grid->size[1] + j) * (int64_t)v->row_words;
    for (uint32_t left = (uint32_t)w->bits[row]; left; left &= left - 1) {
        const int32_t at[3] = {w->at[0][row] + (int32_t)tribox_lowest_bit(left), j, k};
        cell[count] = (cell_bit){words + at[0] / 64, UINT64_C(1) << at[0] % 64};
        if (*cell[count].word & cell[count].bit)
            continue;
        for (int m = 0; m < 9; m++)
            batch->number[m][count] = w->u[m][row];
        for (int a = 0; a < 3; a++) {
            batch->number[9 + a][count] = tribox_grid_plane(v->grid, a, (uint64_t)at[a]);
            batch->number[12 + a][count] = tribox_grid_plane(v->grid, a, (uint64_t)at[a] + 1);
        }
        if (++count == TRIBOX_BATCH) {
            settle_batch(v, batch, count, cell);
            count = 0;
        }
    }
    return count;
}

void tribox_voxels_settle(tribox_voxels *v)
{
    tribox_batch batch;
    cell_bit cell[TRIBOX_BATCH];
    unsigned count = 0;
    v->plan.kernel->cells->write(v);
    for (unsigned row = 0; row < v->waiting.count; row++)
        count = add_row(v, row, &batch, count, cell);
    if (count)
        settle_batch(v, &batch, count, cell);
    v->waiting.count = 0;
}
