/* layers_work.h - an estimate of the work of a voxelization, and of how it is spread over the layers. */
#ifndef LAYERS_WORK_H
#define LAYERS_WORK_H

#include "voxel_task.h"

/* Some triangles one after the other. */
enum { LAYERS_BLOCK = 128 };
typedef struct layers_block {
    double lo, hi;      /* no triangle reaches beyond these along z; one with a NaN, which overlaps nothing, may */
    double nanoseconds; /* roughly */
} layers_block;

/* Looks at triangles start .. start + count - 1, at most LAYERS_BLOCK of them. */
layers_block layers_work_block(const voxel_task *task, size_t start, size_t count);

/* The nanoseconds of all triangles, from a sample. */
double layers_work_sample(const voxel_task *task);

/*
 * Cuts layers first .. first + layers - 1 into slabs of about equal work, by the blocks of all triangles: slab s has border[s] ..
 * border[s + 1] - 1 of the range.
 */
void layers_work_cut(const tribox_grid *grid, uint32_t first, uint32_t layers, const layers_block *blocks, size_t count, int slabs,
                     uint32_t *border);

#endif
