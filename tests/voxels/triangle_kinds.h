/* triangle_kinds.h - named kinds of triangles about a grid, and whole meshes. */
#ifndef TRIBOX_TESTS_TRIANGLE_KINDS_H
#define TRIBOX_TESTS_TRIANGLE_KINDS_H

#include "triangle_list.h"
#include "common/grid_planes.h"
#include "common/random_draws.h"

typedef struct triangle_kind {
    const char *name;
    void (*draw)(random_source *r, const grid_planes *l, float u[3][3]);
    bool is_within_fast; /* neither slivers nor coordinates near the ends of the float range: FAST keeps its band */
} triangle_kind;

size_t triangle_kind_count(void);
const triangle_kind *triangle_kind_at(size_t i);

/* A finite triangle; zeros get a sign that is drawn, and some triangles lie a few floats beside where they were meant to. */
void draw_triangle(random_source *r, const triangle_kind *s, const grid_planes *l, float u[3][3]);

/* A sphere, a torus or cubes on planes of the grid: closed meshes that lie in the grid in part or wholly. */
void draw_mesh(random_source *r, const grid_planes *l, triangle_list *c);

#endif
