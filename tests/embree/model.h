/*
 * model.h - what is voxelized here: soups that are drawn, and closed meshes; which cells of a grid a triangle may meet, and where a
 * line crosses it.
 */
#ifndef TRIBOX_TESTS_MODEL_H
#define TRIBOX_TESTS_MODEL_H

#include <stdbool.h>
#include <stddef.h>

#include "common/grid_planes.h"
#include "common/random_draws.h"

/* Zeroed memory, or the end of the program with a message. */
void *memory_of(size_t count, size_t size);

typedef struct triangle {
    float u[3][3]; /* vertex, axis */
} triangle;

typedef struct model {
    size_t count;
    triangle *triangles;
} model;

/* Triangles in [-1, 1]^3, of which the vertices lie within `size` of each other on every axis; 2 is anywhere. */
model model_soup(random_source *r, size_t count, double size);

/* Those of common/closed_meshes.h. */
model model_icosphere(int levels);
model model_torus(int around, int across, double tube);
model model_cube(int steps);

/* x to scale * x + shift, rounded once; and to the nearest integer. */
void model_place(model *s, const double scale[3], const double shift[3]);
void model_snap(model *s);

/* Every coordinate up or down by one ulp, or not at all. The mesh is no longer closed. */
void model_shake(model *s, random_source *r);

void model_free(model *s);

/* The same triangles as the library takes them. */
typedef struct streams {
    tribox_soup soup;
    float *memory;
} streams;

streams streams_make(const model *s);
void streams_free(streams *s);

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

/* A line along an axis and the plane of a triangle: in double, from the floats that Embree was given. */
typedef struct crossing {
    double t;           /* from the start of the line */
    double place;       /* the coordinate on the axis */
    double barycentric; /* the smallest of the three: below zero outside the triangle */
    double cosine;      /* between the line and the triangle's normal, with its sign */
    double float_error; /* a bound on what Embree's own t may be off */
} crossing;

/* False if the line is parallel to the plane, or the triangle has none. */
bool crossing_make(const triangle *t, int axis, const float from[3], crossing *c);

#endif
