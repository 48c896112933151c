/* mesh.h - a mesh file as a triangle soup. */
#ifndef MESH_H
#define MESH_H

#include "triangle_file.h"
#include "tribox.h"

typedef struct mesh {
    tribox_soup soup;        /* all triangles in the order of the file; polygons are cut, degenerate triangles stay */
    size_t left_out;         /* points and lines of the file */
    size_t uncut;            /* triangles missing, since libassimp could not cut a polygon that crosses itself */
    size_t miscut;           /* polygons of PLY and OFF files whose triangles cover more than they do */
    size_t rounded;          /* vertices of which rounding to float has moved a coordinate; 0 where libassimp reads */
    double moved;            /* the most that it has moved one */
    size_t not_finite;       /* triangles with a NaN or infinite coordinate */
    size_t first_not_finite; /* the first of them */
    size_t capacity;         /* triangles that the streams have room for */
    float *coordinates;      /* what the streams point into */
} mesh;

/*
 * Reads a mesh file: PLY, OFF, STL and raw triangles here, others by libassimp. Coordinates are those of the file, bit for bit
 * where it holds floats, otherwise rounded to the nearest. libassimp may be an ulp off, and applies the transforms of scenes.
 * Returns an exit_code; a file without a triangle is a failure. On success mesh_free gives the memory back.
 */
int mesh_read(const char *path, mesh *m);

/* The same where the format may be given, in place of the name: also of a stream, for which the memory grows; "-" is stdin. */
int mesh_read_as(const char *path, triangle_format format, mesh *m);

/* Makes room for triangles, for which the readers ask. No triangles at all are a failure. Returns an exit_code. */
int mesh_make_room(const char *path, uint64_t count, mesh *m);

/* Says on standard error which triangles are not finite, rounded, missing or cut badly. */
void mesh_warn(const char *path, const mesh *m);

/* Says the first of these, for triangles that are in no mesh; silent if there are none. */
void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first);

void mesh_free(mesh *m);

#endif
