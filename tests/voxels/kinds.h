/* kinds.h - named kinds of grids, for triangles of floats and of doubles; of triangles about a window of one; and whole meshes. */
#ifndef TRIBOX_TESTS_KINDS_H
#define TRIBOX_TESTS_KINDS_H

#include "cells.h"

typedef struct grid_range grid_range;
typedef struct grid_kind {
    const char *name;
    void (*draw)(random_source *r, tribox_grid *grid); /* or NULL, and of numbers in a range */
    const grid_range *range;
    bool is_within_fast; /* coordinates far from the ends of the float range, so that FAST keeps its band */
    bool is_double;      /* of what its triangles are */
} grid_kind;

/* Those of floats come first. */
size_t grid_kind_count(void);
size_t grid_kind_floats(void);
const grid_kind *grid_kind_at(size_t i);

/* A grid of these sizes, but of one cell if that is what the kind is about, without triangles; draws until the planes rise. */
void draw_grid_of_size(random_source *r, const grid_kind *kind, const uint32_t size[3], cells_case *c);

/* The same of any sizes, at most `most` cells; of doubles, where these are many, now and then a long one, which has more. */
void draw_grid_of_kind(random_source *r, const grid_kind *kind, size_t most, cells_case *c);

typedef struct triangle_kind triangle_kind;
struct triangle_kind {
    const char *name;
    void (*draw)(random_source *r, const triangle_kind *s, const cells_case *c, double u[3][3]);
    bool is_within_fast;        /* neither slivers nor coordinates near the ends of the float range: FAST keeps its band */
    bool is_in_cells;           /* vertices are drawn in cells, whole numbers for planes, and not as numbers */
    double along[2], across[2]; /* its lengths on one axis and on the others, as powers of two, between two of them each */
};

/* The first goes through the window from anywhere in the grid. */
size_t triangle_kind_count(void);
const triangle_kind *triangle_kind_at(size_t i);

/* A triangle, of floats a finite one; zeros get any sign, and some lie a few numbers beside where they were meant to. */
void draw_triangle(random_source *r, const triangle_kind *s, const cells_case *c, double u[3][3]);

/*
 * Adds so many of a kind, or of any if it is NULL, a few of them not finite; or fewer if the oracle would be asked about more cells
 * than `cost`.
 */
void put_triangles(random_source *r, const triangle_kind *s, size_t count, size_t cost, cells_case *c);

/* Adds a closed mesh, or cubes on planes of the grid, which lie in the grid in part or wholly. */
void put_mesh(random_source *r, cells_case *c);

#endif
