/* voxel_blocks.c - triangles for which no limits hold (PROOFS.md 7.10). Slow, but right for whatever numbers. */
#include "voxelizing.h"

#include "grid/blocks.h"

static double window_plane(const void *planes, int a, int64_t p) { return tribox_plane_at(planes, a, p); }

/* Whose cells are asked. */
typedef struct asker {
    tribox_voxels *v;
    int32_t number; /* of the triangle */
} asker;

static void set_cell(void *taker, const int64_t at[3])
{
    const asker *const a = taker;
    tribox_voxels *const v = a->v;
    const int64_t row = ((at[2] - v->window.first_layer) * v->window.size[1] + at[1]) * (int64_t)v->sinks.row_words;
    if (v->sinks.pairs) {
        tribox_voxels_pair_row(v, (size_t)row, at[0], at[0], a->number);
        return;
    }
    if (v->sinks.ids.of)
        tribox_lower_row(&v->sinks.ids, v->sinks.occupied, (size_t)row, at[0], at[0], tribox_voxels_id(v, a->number));
    v->counts.overlapping += tribox_set_cells(v->sinks.occupied + row, at[0], at[0]);
}

void tribox_voxels_ask_blocks(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range)
{
    asker asking = {v, triangle->number};
    tribox_plan exact = v->plan;
    exact.accuracy = TRIBOX_EXACT; /* else how blocks are cut would show: they end at the layers that are asked for */
    const tribox_blocks blocks = {
        .plan = &exact, .plane = window_plane, .lattice = &v->window.planes, .take = set_cell, .taker = &asking};
    const int64_t first = tribox_greatest(range->base[2], v->window.first_layer);
    const int64_t end = tribox_least(range->base[2] + range->cells[2], v->window.end_layer);
    const int64_t base[3] = {range->base[0], range->base[1], first}, cells[3] = {range->cells[0], range->cells[1], end - first};
    v->counts.undecided += tribox_blocks_ask(&blocks, triangle->u, base, cells);
}
