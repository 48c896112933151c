/* triangle_kinds.h - named kinds of triangles about a window of a grid, and whole meshes. */
#ifndef TRIBOX_TESTS_TRIANGLE_KINDS_H
#define TRIBOX_TESTS_TRIANGLE_KINDS_H

#include "cells.h"

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
