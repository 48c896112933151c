/* embree_planes.h - the cells of a grid that a triangle may meet. */
#ifndef TRIBOX_TESTS_PLANES_H
#define TRIBOX_TESTS_PLANES_H

#include <stdbool.h>

#include "common/grid_planes.h"
#include "model.h"

/* By their definition. False if the library places a cell elsewhere, or planes do not rise. */
bool planes_make(grid_planes *p, const tribox_grid *grid);

/* The closed cells of an axis that [least, most] meets; none if first > last. */
typedef struct span {
    int first, last;
} span;

span planes_met(const grid_planes *p, int axis, double least, double most);

/* Some cells of the grid, x fastest. */
typedef struct block {
    int first[3], count[3];
} block;

/* The cells that the bounding box of a triangle meets, and one more on every side; clipped to the grid. */
block planes_candidates(const grid_planes *p, const triangle *t);

static inline size_t block_cells(const block *b) { return (size_t)b->count[0] * (size_t)b->count[1] * (size_t)b->count[2]; }

bool block_has(const block *b, const int cell[3]);

/* The number of a cell in its block, and back. */
size_t block_number(const block *b, const int cell[3]);
void block_cell(const block *b, size_t number, int cell[3]);

/* Where a cell lies among the bits of tribox_voxelize. */
size_t planes_bit(const grid_planes *p, const int cell[3]);

#endif
