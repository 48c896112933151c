/*
 * model.h - what is voxelized here, soups that are drawn and closed meshes; the planes of a grid by their definition, which cells a
 * triangle may meet, and where a line crosses it.
 */
#ifndef TRIBOX_TESTS_MODEL_H
#define TRIBOX_TESTS_MODEL_H

#include <stdbool.h>
#include <stddef.h>

#include "common/random_draws.h"
#include "tribox.h"

/* Zeroed memory, or the end of the program with a message. */
void *memory_of(size_t count, size_t size);

typedef struct triangle {
    float u[3][3]; /* vertex, axis */
} triangle;

typedef struct model {
    size_t count;
    triangle *triangles;
} model;

/*
 * In [-1, 1]^3. SOUP: `count` triangles, whose vertices lie within `size` of each other on every axis; 2 is anywhere. `size` of a
 * torus is that of its tube.
 */
typedef enum shape { SOUP, ICOSPHERE, TORUS, CUBE } shape;
model model_make(shape s, size_t count, double size, random_source *r);

/* x to scale * x + shift, rounded once; and to the nearest integer. */
void model_place(model *m, double scale, double shift);
void model_snap(model *m);

/* The same triangles as the library takes them. Returns their memory. */
float *model_soup(const model *m, tribox_soup *soup);

enum { CELLS_MAX = 64 /* on one axis */ };

typedef struct planes {
    tribox_grid grid;
    double at[3][CELLS_MAX + 1];
} planes;

void planes_make(planes *p, const tribox_grid *grid);

tribox_box planes_cell(const planes *p, const int cell[3]);

/* Where a cell lies among the bits of tribox_voxelize. */
size_t planes_bit(const planes *p, const int cell[3]);

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

/* The number of a cell in its block, block_cells(b) if it is elsewhere; and back. */
size_t block_number(const block *b, const int cell[3]);
void block_cell(const block *b, size_t number, int cell[3]);

/* How far from its start a line along an axis meets a triangle. False if it does not, or lies in its plane, or there is none. */
bool crossing_of(const triangle *t, int axis, const float from[3], double *at);

#endif
