/* closed_meshes.h - closed meshes made of formulas, about the origin and within [-1, 1]^3, a triangle at a time. */
#ifndef TRIBOX_TESTS_CLOSED_MESHES_H
#define TRIBOX_TESTS_CLOSED_MESHES_H

#include "random_draws.h"

/* What takes the triangles. Corners that are one vertex are the same to the last bit. */
typedef struct closed_mesh_sink {
    void (*put)(void *mesh, const double a[3], const double b[3], const double c[3]);
    void *mesh;
} closed_mesh_sink;

/* Of 20 * 4^levels, 2 * around * across (about the z axis) and 12 * steps^2 triangles. */
void closed_icosphere(const closed_mesh_sink *to, int levels);
void closed_torus(const closed_mesh_sink *to, int around, int across, double tube);
void closed_cube(const closed_mesh_sink *to, int steps);

/* A sphere of 2 * around * across triangles with poles on the z axis, where half of them have no area. */
void closed_globe(const closed_mesh_sink *to, int around, int across);

/* Any of these. Returns its name. */
const char *closed_any(const closed_mesh_sink *to, random_source *r);

#endif
