/* planes.h - the planes of a grid as the library places them, and the cells between them. */
#ifndef TRIBOX_TESTS_PLANES_H
#define TRIBOX_TESTS_PLANES_H

#include <stdbool.h>

#include "model.h"

enum { PLANES_CELLS = 128 /* on one axis at most */ };

typedef struct planes {
    tribox_grid grid;
    int size[3];
    float at[3][PLANES_CELLS + 1];
} planes;

/* Asks the library for every cell. False if two neighbours do not share the very same plane, or planes do not rise. */
bool planes_make(planes *p, const tribox_grid *grid);

tribox_box planes_cell(const planes *p, const int cell[3]);

/* The closed cells of an axis that [least, most] meets; none if first > last. */
typedef struct span {
    int first, last;
} span;

span planes_met(const planes *p, int axis, double least, double most);

/* Some cells of the grid, x fastest. */
typedef struct block {
    int first[3], count[3];
} block;

/* The cells that the bounding box of a triangle meets, and one more on every side; clipped to the grid. */
block planes_candidates(const planes *p, const triangle *t);

static inline size_t block_cells(const block *b) { return (size_t)b->count[0] * (size_t)b->count[1] * (size_t)b->count[2]; }

bool block_has(const block *b, const int cell[3]);

/* The number of a cell in its block, and back. */
size_t block_number(const block *b, const int cell[3]);
void block_cell(const block *b, size_t number, int cell[3]);

/* Where a cell lies among the bits of tribox_voxelize. */
size_t planes_bit(const planes *p, const int cell[3]);

#endif
