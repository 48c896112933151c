/* indexed_mesh.h - what a reader finds in a file: vertices, and triangles that refer to them. Polygons are cut as they come. */
#ifndef INDEXED_MESH_H
#define INDEXED_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "console/written_number.h"

typedef struct indexed_mesh {
    void *positions;         /* x, y, z of each vertex */
    unsigned position_bytes; /* 4: floats, 8: doubles, of which each is a float if `fit` says so */
    float_fit fit;           /* the worst of all coordinates */
    size_t vertices, vertices_max;
    uint32_t *corners; /* three vertices of each triangle */
    size_t triangles, triangles_max;
    uint32_t *face; /* the corners of the face that is being read */
    size_t face_max;
    size_t left_out; /* points and lines */
    size_t miscut;   /* polygons whose triangles cover more than they do */
} indexed_mesh;

/* Makes room for as many vertices at least, of floats or doubles. Returns an exit_code; path is for the message. */
int indexed_mesh_reserve(const char *path, uint64_t vertices, unsigned position_bytes, indexed_mesh *m);

/* Adds a vertex, for which there is room. */
void indexed_mesh_add_vertex(const double position[3], indexed_mesh *m);

/* Doubles that are floats, or decimals that floats give back, become floats. Others stay. */
void indexed_mesh_narrow(indexed_mesh *m);

/* Makes room for the corners of a face, in m->face. Returns an exit_code. */
int indexed_mesh_reserve_face(const char *path, uint64_t corners, indexed_mesh *m);

void indexed_mesh_position(const indexed_mesh *m, uint32_t vertex, double position[3]);

/*
 * Adds m->face, whose corners are vertices that there are: cut into a fan around its first corner that sees all of it, where there
 * is one, else by cutting off its ears. Returns an exit_code.
 */
int indexed_mesh_add_face(const char *path, size_t corners, indexed_mesh *m);

/* Adds one triangle. Returns an exit_code. */
int indexed_mesh_add_triangle(const char *path, uint32_t a, uint32_t b, uint32_t c, indexed_mesh *m);

void indexed_mesh_free(indexed_mesh *m);

#endif
