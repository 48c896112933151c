/* indexed_mesh.h - what a reader finds in a file: vertices, and triangles that refer to them. Polygons are cut as they come. */
#ifndef INDEXED_MESH_H
#define INDEXED_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct indexed_mesh {
    float *positions; /* x, y, z of each vertex */
    size_t vertices, vertices_max;
    uint32_t *corners; /* three vertices of each triangle */
    size_t triangles, triangles_max;
    uint32_t *face; /* the corners of the face that is being read */
    size_t face_max;
    size_t left_out; /* points and lines */
    size_t miscut;   /* polygons whose triangles cover more than they do */
    size_t rounded;  /* vertices with a coordinate that rounding to float has moved */
    double moved;    /* the most that one of their coordinates has moved */
} indexed_mesh;

/* Makes room for vertices, before the first of them. Returns an exit_code; path is for the message. */
int indexed_mesh_reserve(const char *path, uint64_t vertices, indexed_mesh *m);

/* moved: how far rounding has moved the three coordinates. There has to be room for the vertex. */
void indexed_mesh_add_vertex(const float position[3], const double moved[3], indexed_mesh *m);

/* Makes room for the corners of a face, in m->face. Returns an exit_code. */
int indexed_mesh_reserve_face(const char *path, uint64_t corners, indexed_mesh *m);

/*
 * Adds m->face, whose corners are vertices that there are: cut into a fan around its first corner that sees all of it, where there
 * is one. Returns an exit_code.
 */
int indexed_mesh_add_face(const char *path, size_t corners, indexed_mesh *m);

/* Adds one triangle. Returns an exit_code. */
int indexed_mesh_add_triangle(const char *path, uint32_t a, uint32_t b, uint32_t c, indexed_mesh *m);

void indexed_mesh_free(indexed_mesh *m);

#endif
