/* voxel_waiting.c - open cells: they wait, and are settled by their own boxes. */
#include "voxels.h"

#include "grid_cells.h"
#include "settle.h"

/* The word of a cell, and its bit there. */
typedef struct cell_bit {
    uint64_t *word, bit;
} cell_bit;

static cell_bit bit_of(const tribox_voxels *v, const int32_t at[3])
{
    const int64_t row = (at[2] - v->first_layer) * (int64_t)v->grid->size[1] + at[1];
    return (cell_bit){v->occupied + row * (int64_t)v->row_words + at[0] / 64, UINT64_C(1) << at[0] % 64};
}

void tribox_voxels_wait(tribox_voxels *v, const float u[9], int64_t first, int64_t last, int64_t j, int64_t k)
{
    for (int64_t i = first; i <= last; i++) {
        if (v->waiting.count == TRIBOX_WAITING)
            tribox_voxels_settle(v);
        const unsigned n = v->waiting.count++;
        for (int m = 0; m < 9; m++)
            v->waiting.cell[n].u[m] = u[m];
        v->waiting.cell[n].at[0] = (int32_t)i;
        v->waiting.cell[n].at[1] = (int32_t)j;
        v->waiting.cell[n].at[2] = (int32_t)k;
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

void tribox_voxels_settle(tribox_voxels *v)
{
    tribox_batch batch;
    cell_bit cell[TRIBOX_BATCH];
    unsigned count = 0;
    v->plan.kernel->cells->write(v);
    for (unsigned n = 0; n < v->waiting.count; n++) {
        const int32_t *const at = v->waiting.cell[n].at;
        cell[count] = bit_of(v, at);
        if (*cell[count].word & cell[count].bit)
            continue;
        for (int m = 0; m < 9; m++)
            batch.number[m][count] = v->waiting.cell[n].u[m];
        for (int a = 0; a < 3; a++) {
            batch.number[9 + a][count] = tribox_grid_plane(v->grid, a, (uint64_t)at[a]);
            batch.number[12 + a][count] = tribox_grid_plane(v->grid, a, (uint64_t)at[a] + 1);
        }
        if (++count == TRIBOX_BATCH) {
            settle_batch(v, &batch, count, cell);
            count = 0;
        }
    }
    if (count)
        settle_batch(v, &batch, count, cell);
    v->waiting.count = 0;
}
