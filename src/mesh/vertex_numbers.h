/* vertex_numbers.h - which vertex stands at a corner of a mesh: corner 3 * i + v is vertex v of triangle i. */
#ifndef TRIBOX_VERTEX_NUMBERS_H
#define TRIBOX_VERTEX_NUMBERS_H

#include <string.h>

#include "tribox.h"

/* 0 where there are no indices. */
static inline unsigned tribox_vertex_bytes(const tribox_mesh *mesh) { return mesh->indices ? mesh->index_bytes : 0; }

/* index_bytes: that of the mesh, as an argument of its own so that it can be a constant. */
static inline size_t tribox_vertex_number(const tribox_mesh *mesh, unsigned index_bytes, size_t corner)
{
    uint16_t narrow;
    uint32_t wide;
    if (index_bytes == 2) {
        memcpy(&narrow, (const char *)mesh->indices + 2 * corner, sizeof narrow);
        return narrow;
    }
    if (index_bytes == 4) {
        memcpy(&wide, (const char *)mesh->indices + 4 * corner, sizeof wide);
        return wide;
    }
    return corner;
}

#endif
