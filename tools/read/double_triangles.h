/* double_triangles.h - a file of raw doubles in memory, and how memory grows for files of unknown length. */
#ifndef DOUBLE_TRIANGLES_H
#define DOUBLE_TRIANGLES_H

#include "triangle_file.h"

typedef struct double_triangles {
    double *positions; /* x, y, z of the three vertices of each triangle */
    size_t count, capacity;
} double_triangles;

/* Reads all triangles. Returns an exit_code: on success with at least one, in memory for free(). */
int double_triangles_read(triangle_file *file, double_triangles *found);

/* The next room for a stream of which `count` triangles are read into room for `there`. Returns an exit_code. */
int triangles_more_room(const char *name, size_t count, size_t there, size_t triangle_bytes, uint64_t *room);

#endif
