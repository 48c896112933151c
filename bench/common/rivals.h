/* rivals.h - what tribox is measured against: the loads alone, the paper's test without branches, and voxelizers in float. */
#ifndef BENCH_RIVALS_H
#define BENCH_RIVALS_H

#include <stdbool.h>

#include "tribox.h"

/* The exclusive or of the bits of all coordinates: it takes all nine streams, whole, and one instruction for each load. */
uint32_t loads_all(const tribox_soup *soup);

/* The exclusive or of `count` words, at any alignment. */
uint32_t loads_words(const void *words, size_t count);

/* Bit i % 64 of mask[i / 64] is set if triangle i overlaps the box, but for rounding. center, half: of the box. */
void unbranched_overlap(const tribox_soup *soup, const float center[3], const float half[3], uint64_t *mask);

/*
 * What tribox_voxelize is measured against. Both set the bits of the same layout, and round cells in float. Cells are cubes; the
 * grid's lower corner is `origin`; triangles[i][j][a] is axis a of vertex j, and lies in the grid.
 */
typedef void voxel_rival(const tribox_grid *grid, const float (*triangles)[3][3], size_t count, uint64_t *occupied);

/* The paper's test for every cell that the bounding box of a triangle touches. */
voxel_rival voxelize_cell_by_cell;

/*
 * The surface voxelization of M. Schwarz, H.-P. Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs", ACM Transactions on
 * Graphics 29(6), 2010: per triangle its plane's two critical points and nine edge functions in the three projections; per cell of
 * the bounding box the plane and the edges. What does not depend on x is taken out of the row; a row that its edges reject is
 * passed over. A triangle whose box spans cells on one axis alone overlaps them all; for one whose box is one cell thick the edges
 * of one projection decide. Walks that leave out cells, by columns along the largest axis of the normal, are not in it.
 */
voxel_rival voxelize_schwarz_seidel;

#endif
