/* model.h - what is voxelized here: soups that are drawn, and closed meshes. */
#ifndef TRIBOX_TESTS_MODEL_H
#define TRIBOX_TESTS_MODEL_H

#include <stddef.h>

#include "common/random_draws.h"
#include "tribox.h"

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

#endif
