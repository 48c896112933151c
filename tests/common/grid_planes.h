/* grid_planes.h - a grid and the numbers of its planes, by the definition in tribox.h, with no help of the library. */
#ifndef TRIBOX_TESTS_GRID_PLANES_H
#define TRIBOX_TESTS_GRID_PLANES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "tribox.h"

enum { GRID_PLANES_CELLS = 1200 /* on one axis at most */ };

typedef struct grid_planes {
    tribox_grid grid;
    double plane[3][GRID_PLANES_CELLS + 1];
    size_t row_words;
    size_t words; /* of the whole grid */
} grid_planes;

/* The float nearest to plane p of an axis, also outside of the grid, and between planes: always a finite number. */
float grid_planes_place(const tribox_grid *grid, int axis, double p);

/* False if two planes are one double, or one is not finite. */
bool grid_planes_make(grid_planes *l, const tribox_grid *grid);

tribox_box grid_planes_cell(const grid_planes *l, int i, int j, int k);

static inline size_t grid_planes_word(const grid_planes *l, int i, int j, int k)
{
    return ((size_t)k * l->grid.size[1] + (size_t)j) * l->row_words + (size_t)i / 64;
}

static inline bool grid_planes_bit(const grid_planes *l, const uint64_t *occupied, int i, int j, int k)
{
    return occupied[grid_planes_word(l, i, j, k)] >> i % 64 & 1;
}

static inline void grid_planes_set(const grid_planes *l, uint64_t *occupied, int i, int j, int k)
{
    occupied[grid_planes_word(l, i, j, k)] |= UINT64_C(1) << i % 64;
}

/* The closed cells of an axis that [least, most] touches: every plane is looked at. None if *first > *last. */
void grid_planes_range(const grid_planes *l, int axis, float least, float most, int *first, int *last);

/* In hexadecimal numbers. */
void grid_planes_print(FILE *out, const tribox_grid *grid);

#endif
