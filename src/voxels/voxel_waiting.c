/* voxel_waiting.c - undecided cells: they wait, and are settled by their own boxes. */
#include "voxelizing.h"

#include "base/finite.h"
#include "pairs/settle.h"

/* The word of a cell, its bit there, and the number of the triangle that it waits with. */
typedef struct cell_bit {
    size_t word;
    uint64_t bit;
    int32_t number;
} cell_bit;

void tribox_voxels_wait_everywhere(tribox_voxels *v, const tribox_triangle *triangle)
{
    if (!tribox_are_finite_doubles(triangle->u, 9))
        return;
    for (int64_t k = v->window.first_layer; k < v->window.end_layer; k++)
        for (int64_t j = 0; j < v->window.size[1]; j++)
            tribox_voxels_wait_for_row(v, triangle, 0, (int64_t)v->window.size[0] - 1, j, k);
}

static void lower_id(const tribox_voxels *v, const cell_bit *cell)
{
    uint32_t *const ids = tribox_ids_of_word(&v->sinks.ids, (uint32_t)cell->word);
    tribox_lower_ids(&v->sinks.ids, ids, v->sinks.occupied[cell->word], cell->bit, tribox_voxels_id(v, cell->number));
}

static void settle_batch(tribox_voxels *v, tribox_batch *batch, unsigned count, const cell_bit *cell)
{
    v->counts.undecided += count;
    const tribox_verdict verdict = tribox_settle_batch(batch, count, &v->plan);
    for (uint64_t left = verdict.overlapping; left; left &= left - 1) {
        const unsigned i = tribox_lowest_bit(left);
        if (v->sinks.pairs) {
            tribox_voxels_pair(v, cell[i].word, cell[i].bit, cell[i].number);
            continue;
        }
        if (v->sinks.ids.of)
            lower_id(v, &cell[i]);
        v->counts.overlapping += tribox_set_bits(v->sinks.occupied + cell[i].word, cell[i].bit);
    }
}

/* The first word of row n of those that wait. */
static size_t row_of(const tribox_voxels *v, unsigned n)
{
    const int64_t layer = (uint32_t)v->sinks.waiting.at[2][n] - v->window.first_layer;
    return (size_t)(layer * (int64_t)v->window.size[1] + (uint32_t)v->sinks.waiting.at[1][n]) * v->sinks.row_words;
}

/* Those of these set cells whose id is greater than that of the triangle that they wait with. */
static uint32_t cells_of_greater_id(const tribox_voxels *v, unsigned n, uint32_t cells)
{
    const uint32_t i = (uint32_t)v->sinks.waiting.at[0][n], id = tribox_voxels_id(v, v->sinks.waiting.number[n]);
    const uint32_t *const ids = tribox_ids_of_word(&v->sinks.ids, (uint32_t)row_of(v, n)) + i;
    uint32_t greater = 0;
    for (; cells; cells &= cells - 1) {
        const unsigned b = tribox_lowest_bit(cells);
        greater |= (uint32_t)(ids[b] > id) << b;
    }
    return greater;
}

/*
 * Those of its cells that are to be settled, as they are not set by now: most rows have none. Cells may go on in the next word. Of
 * pairs all are.
 */
static uint32_t open_cells(const tribox_voxels *v, unsigned n)
{
    const uint32_t i = (uint32_t)v->sinks.waiting.at[0][n], from = i % 64;
    const uint32_t bits = (uint32_t)v->sinks.waiting.bits[n];
    if (v->sinks.pairs)
        return bits;
    const uint64_t *const word = v->sinks.occupied + row_of(v, n) + i / 64;
    const uint64_t next = word[(size_t)i / 64 + 1 < v->sinks.row_words];
    const uint32_t set = (uint32_t)(word[0] >> from | next << 1 << (63 - from));
    return (bits & ~set) | (v->sinks.ids.of ? cells_of_greater_id(v, n, bits & set) : 0);
}

static double plane_at(const tribox_voxels *v, int a, uint32_t p, uint32_t above)
{
    return tribox_plane_at(&v->window.planes, a, (int64_t)p + above);
}

/* The numbers of a batch that all cells of row n have: those of the triangle, and the bounds across the row. */
static void read_row(const tribox_voxels *v, unsigned n, double number[15])
{
    const tribox_triangle triangle =
        v->window.doubles ? tribox_window_read_triangle(&v->window, v->sinks.waiting.number[n]) : (tribox_triangle){.number = 0};
    for (int m = 0; m < 9; m++)
        number[m] = v->window.doubles ? triangle.u[m] : v->sinks.waiting.u[m][n];
    for (int a = 1; a < 3; a++) {
        number[9 + a] = plane_at(v, a, (uint32_t)v->sinks.waiting.at[a][n], 0);
        number[12 + a] = plane_at(v, a, (uint32_t)v->sinks.waiting.at[a][n], 1);
    }
}

void tribox_voxels_settle_waiting(tribox_voxels *v)
{
    tribox_batch batch;
    cell_bit cell[TRIBOX_BATCH];
    uint32_t left[TRIBOX_WAITING];
    unsigned row[TRIBOX_WAITING], rows = 0, count = 0;
    v->plan.kernel->cells->write(v);
    for (unsigned n = 0; n < v->sinks.waiting.count; n++) {
        row[rows] = n;
        left[rows] = open_cells(v, n);
        rows += left[rows] != 0;
    }
    for (unsigned r = 0; r < rows; r++) {
        double number[15];
        read_row(v, row[r], number);
        for (; left[r]; left[r] &= left[r] - 1) {
            const uint32_t i = (uint32_t)v->sinks.waiting.at[0][row[r]] + tribox_lowest_bit(left[r]);
            cell[count] = (cell_bit){row_of(v, row[r]) + i / 64, UINT64_C(1) << i % 64, v->sinks.waiting.number[row[r]]};
            number[9] = plane_at(v, 0, i, 0);
            number[12] = plane_at(v, 0, i, 1);
            for (int m = 0; m < 15; m++)
                batch.number[m][count] = number[m];
            if (++count == TRIBOX_BATCH) {
                settle_batch(v, &batch, count, cell);
                count = 0;
            }
        }
    }
    if (count)
        settle_batch(v, &batch, count, cell);
    v->sinks.waiting.count = 0;
    v->plan.kernel->cells->write(v); /* who lists goes on with as much room as before */
}
