/* shapes.h - what the tests of voxels ask, the other half: named kinds of triangles about a grid, and whole meshes. */
#ifndef TRIBOX_TESTS_SHAPES_H
#define TRIBOX_TESTS_SHAPES_H

#include "crowd.h"
#include "lattice.h"
#include "common/random.h"

typedef struct shape {
    const char *name;
    void (*draw)(random_source *r, const lattice *l, float u[3][3]);
    bool is_within_fast; /* neither slivers nor coordinates near the ends of the float range: FAST keeps its band */
} shape;

size_t shape_count(void);
const shape *shape_at(size_t i);

/* A finite triangle; zeros get a sign that is drawn, and some triangles lie a few floats beside where they were meant to. */
void draw_shape(random_source *r, const shape *s, const lattice *l, float u[3][3]);

/* A sphere, a torus or cubes on planes of the grid: closed meshes that lie in the grid in part or wholly. */
void draw_mesh(random_source *r, const lattice *l, crowd *c);

#endif
