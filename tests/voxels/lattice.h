/* lattice.h - a grid and the numbers of its planes, by the definition in tribox.h, with no help of the library. */
#ifndef TRIBOX_TESTS_LATTICE_H
#define TRIBOX_TESTS_LATTICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "tribox.h"

enum { LATTICE_CELLS = 1200 /* on one axis at most */ };

typedef struct lattice {
    tribox_grid grid;
    float plane[3][LATTICE_CELLS + 1];
    size_t row_words;
    size_t words; /* of the whole grid */
} lattice;

/* Plane p of an axis, also outside of the grid, and between planes: always a finite number. */
float lattice_place(const tribox_grid *grid, int axis, double p);

/* False if two planes are one float, or one is not finite. */
bool lattice_make(lattice *l, const tribox_grid *grid);

tribox_box lattice_cell(const lattice *l, int i, int j, int k);

static inline size_t lattice_word(const lattice *l, int i, int j, int k)
{
    return ((size_t)k * l->grid.size[1] + (size_t)j) * l->row_words + (size_t)i / 64;
}

static inline bool lattice_bit(const lattice *l, const uint64_t *occupied, int i, int j, int k)
{
    return occupied[lattice_word(l, i, j, k)] >> i % 64 & 1;
}

static inline void lattice_set(const lattice *l, uint64_t *occupied, int i, int j, int k)
{
    occupied[lattice_word(l, i, j, k)] |= UINT64_C(1) << i % 64;
}

/* The closed cells of an axis that [least, most] touches: every plane is looked at. None if *first > *last. */
void lattice_range(const lattice *l, int axis, float least, float most, int *first, int *last);

/* In hexadecimal floats. */
void lattice_print(FILE *out, const tribox_grid *grid);

#endif
