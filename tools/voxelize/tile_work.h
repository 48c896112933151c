/* tile_work.h - an estimate of what the triangles of each tile cost, for shards of equal work. */
#ifndef TILE_WORK_H
#define TILE_WORK_H

#include <stdbool.h>

#include "tile_set.h"

/* Nanoseconds that a tile takes by itself. */
enum { TILE_WORK = 62000 };

/*
 * What a triangle costs in each of `tiles` tiles that it is in, of this side: whole, so that the sum of a tile is the same in
 * whatever order its triangles are met. u: x, y, z of each vertex.
 */
uint64_t tile_work_of(const tribox_grid *grid, uint32_t side, const double u[9], uint32_t tiles);

/* Writes the work of the set's own records, which have lists. False where there is no memory. */
bool tile_work_estimate(const tile_set *set, partition_tile *records);

#endif
