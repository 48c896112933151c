/* shape.h - what is voxelized here: soups that are drawn, and closed meshes made of formulas. */
#ifndef TRIBOX_TESTS_SHAPE_H
#define TRIBOX_TESTS_SHAPE_H

#include <stddef.h>

#include "common/random.h"
#include "tribox.h"

typedef struct triangle {
    float u[3][3]; /* vertex, axis */
} triangle;

typedef struct shape {
    size_t count;
    triangle *triangles;
} shape;

/* Triangles in [-1, 1]^3, of which the vertices lie within `size` of each other on every axis; 2 is anywhere. */
shape shape_soup(random_source *r, size_t count, double size);

/* Closed meshes about the origin, within [-1, 1]^3: of 20 * 4^levels, 2 * around * across and 12 * steps^2 triangles. */
shape shape_icosphere(int levels);
shape shape_torus(int around, int across, double tube);
shape shape_cube(int steps);

/* x to scale * x + shift, rounded once; and to the nearest integer. */
void shape_place(shape *s, const double scale[3], const double shift[3]);
void shape_snap(shape *s);

/* Every coordinate up or down by one ulp, or not at all. The mesh is no longer closed. */
void shape_shake(shape *s, random_source *r);

void shape_free(shape *s);

/* The same triangles as the library takes them. */
typedef struct streams {
    tribox_soup soup;
    float *memory;
} streams;

streams streams_make(const shape *s);
void streams_free(streams *s);

#endif
