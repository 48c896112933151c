/* listed.h - the triangles that a list names, as streams. */
#ifndef TRIBOX_LISTED_H
#define TRIBOX_LISTED_H

#include "triangles.h"

/* Triangles are gathered a block at a time, as nine streams and a number each; whole packets are read. */
enum { TRIBOX_LISTED = 1024, TRIBOX_LISTED_STREAM = TRIBOX_LISTED + TRIBOX_LANES_MAX };
typedef struct tribox_listed {
    float u[9][TRIBOX_LISTED_STREAM];
    int32_t number[TRIBOX_LISTED_STREAM];
} tribox_listed;

/* Whether the triangles have these numbers, and their vertices are there. */
bool tribox_listed_are_there(const tribox_triangles *triangles, const tribox_kernel *kernel, const uint32_t *list, size_t count);

/*
 * Triangles list[first] .. list[first + count - 1] into the block, or first .. first + count - 1 where list is NULL: floats as they
 * are, doubles less `origin`, then rounded.
 */
tribox_soup tribox_listed_gather(const tribox_triangles *triangles, const tribox_kernel *kernel, const double origin[3],
                                 const uint32_t *list, size_t first, size_t count, tribox_listed *block);

#endif
