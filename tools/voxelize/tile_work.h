/* tile_work.h - an estimate of what the triangles of each tile cost, for shards of equal work. */
#ifndef TILE_WORK_H
#define TILE_WORK_H

#include <stdbool.h>

#include "tile_set.h"

/* Writes the work of the set's own records, which have lists. False where there is no memory. */
bool tile_work_estimate(const tile_set *set, partition_tile *records);

#endif
