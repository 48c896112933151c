/* mesh.h - a mesh file as a triangle soup, read by libassimp or, where one triangle lies behind the other, without it. */
#ifndef MESH_H
#define MESH_H

#include "triangle_file.h"
#include "tribox.h"

typedef struct mesh {
    tribox_soup soup;  /* all triangles in the order of the file; polygons are cut, degenerate triangles stay */
    size_t left_out;   /* points and lines of the file */
    size_t uncut;      /* triangles missing, since libassimp could not cut a polygon that crosses itself */
    size_t not_finite; /* triangles with a NaN or infinite coordinate */
    size_t first_not_finite;
    size_t capacity;    /* triangles that the streams have room for */
    float *coordinates; /* what the streams point into */
} mesh;

/*
 * Reads a mesh file. Scene transforms are applied; where there are none, coordinates are those of the file, bit for bit.
 * Returns an exit_code; a file without a triangle is a failure. On success mesh_free gives the memory back.
 */
int mesh_read(const char *path, mesh *m);

/* The same for a regular file whose format may be told, in place of its name. */
int mesh_read_as(const char *path, triangle_format format, mesh *m);

/* Tells on standard error of triangles that are not finite, and of those that are missing. */
void mesh_warn(const char *path, const mesh *m);

/* The first half of it, for triangles that are in no mesh; silent if there are none. */
void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first);

void mesh_free(mesh *m);

#endif
