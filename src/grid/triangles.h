/* triangles.h - triangles to be read, of a soup or of a mesh, so that calls about both are one text. */
#ifndef TRIBOX_TRIANGLES_H
#define TRIBOX_TRIANGLES_H

#include "kernel.h"

typedef struct tribox_triangles {
    bool is_soup, are_doubles;
    const tribox_soup *soup; /* or, not set where the other is: a copy of few words costs 10 ns where they were written just now */
    tribox_mesh mesh;        /* its strides set */
    size_t count;
} tribox_triangles;

/* False where they cannot be read; vertex numbers of a mesh may still be too great. */
bool tribox_triangles_of_soup(const tribox_soup *soup, tribox_triangles *triangles);
bool tribox_triangles_of_mesh(const tribox_mesh *mesh, tribox_triangles *triangles);

/* Whether all vertices are there. */
bool tribox_triangles_have_vertices(const tribox_triangles *triangles, const tribox_kernel *kernel);

/* Triangles first .. first + count - 1 of a soup. */
tribox_soup tribox_soup_part(const tribox_soup *soup, size_t first, size_t count);

/* Room for triangles of a mesh as streams, which fit the nearest cache, or for the few of a soup that fill no packet. */
enum { TRIBOX_STREAMED = 256 };
typedef union tribox_stream_room {
    _Alignas(64) float number[9][TRIBOX_STREAMED];
    tribox_partial_packet few;
} tribox_stream_room;

/* How many triangles can be read as streams at a time: of a soup all. */
size_t tribox_triangles_at_once(const tribox_triangles *triangles);

/*
 * Triangles first .. first + count - 1 as streams of which whole packets can be read: of a soup where they lie, if they fill a
 * packet. Floats are as they are; doubles are less `origin`, the difference taken in double, and rounded.
 */
tribox_soup tribox_triangles_stream(const tribox_triangles *triangles, const tribox_kernel *kernel, const double origin[3],
                                    size_t first, size_t count, tribox_stream_room *room);

/* Number n of triangle first + i, in the order x_0 x_1 x_2 y_0 .. z_2, goes to to[n * step + i]. */
void tribox_triangles_read(const tribox_triangles *triangles, size_t first, size_t count, double *to, size_t step);

#endif
