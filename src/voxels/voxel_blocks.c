/* voxel_blocks.c - triangles for which no limits hold (PROOFS.md 7.10). Slow, but right for whatever numbers. */
#include "voxelizing.h"

#include "grid/blocks.h"

static double window_plane(const void *planes, int a, int64_t p) { return tribox_plane_at(planes, a, p); }

static void set_cell(void *voxels, const int64_t at[3])
{
    tribox_voxels *const v = voxels;
    const int64_t row = (at[2] - v->window.first_layer) * v->window.size[1] + at[1];
    v->counts.overlapping += tribox_set_cells(v->sinks.occupied + row * (int64_t)v->sinks.row_words, at[0], at[0]);
}

void tribox_voxels_ask_blocks(tribox_voxels *v, const tribox_triangle *triangle, const tribox_cell_range *range)
{
    const tribox_blocks blocks = {
        .plan = &v->plan, .plane = window_plane, .lattice = &v->window.planes, .take = set_cell, .taker = v};
    const int64_t first = tribox_greatest(range->base[2], v->window.first_layer);
    const int64_t end = tribox_least(range->base[2] + range->cells[2], v->window.end_layer);
    const int64_t base[3] = {range->base[0], range->base[1], first}, cells[3] = {range->cells[0], range->cells[1], end - first};
    v->counts.undecided += tribox_blocks_ask(&blocks, triangle->u, base, cells);
}
