/* grid_kinds.h - what the tests of voxels ask, one half: named kinds of grids. */
#ifndef TRIBOX_TESTS_GRID_KINDS_H
#define TRIBOX_TESTS_GRID_KINDS_H

#include "common/grid_planes.h"
#include "common/random_draws.h"

typedef struct grid_kind {
    const char *name;
    void (*draw)(random_source *r, tribox_grid *grid);
    bool is_within_fast; /* coordinates far from the ends of the float range, so that FAST keeps its band */
} grid_kind;

size_t grid_kind_count(void);
const grid_kind *grid_kind_at(size_t i);

/* A grid of these sizes, but of one cell if that is what the kind is about; draws until the planes rise strictly. */
void draw_grid_of_size(random_source *r, const grid_kind *kind, const uint32_t size[3], grid_planes *l);

/* The same of any sizes, at most `cells` cells. */
void draw_grid_of_kind(random_source *r, const grid_kind *kind, size_t cells, grid_planes *l);

#endif
