/*
 * voxel_rivals.h - what tribox_voxelize is measured against. Both set the bits of the same layout, and round cells in float.
 *
 * Cells are cubes; the grid's lower corner is `origin`; triangles[i][j][a] is axis a of vertex j, and lies in the grid.
 */
#ifndef BENCH_VOXEL_RIVALS_H
#define BENCH_VOXEL_RIVALS_H

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef void voxel_rival(const tribox_grid *grid, const float (*triangles)[3][3], size_t count, uint64_t *occupied);

/** The paper's test (baseline.h) called for every cell that the bounding box of a triangle touches. */
voxel_rival voxelize_cell_by_cell;

/**
 * M. Schwarz, H.-P. Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs", ACM Transactions on Graphics 29(6), 2010,
 * section 3.1: conservative surface voxelization. Per triangle its plane's two critical points and nine edge functions in the three
 * projections; per cell the plane and those of the edges that depend on x, per row the others. A triangle whose box spans cells on
 * one axis alone overlaps them all.
 */
voxel_rival voxelize_schwarz_seidel;

#ifdef __cplusplus
}
#endif

#endif
