/* grid_kinds.h - named kinds of grids, for triangles of floats and of doubles. */
#ifndef TRIBOX_TESTS_GRID_KINDS_H
#define TRIBOX_TESTS_GRID_KINDS_H

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

#endif
