/*
 * positions.h - which vertex stands at a corner of a mesh, corner 3 * i + v being vertex v of triangle i, and the numbers of
 * vertices, one by one. The strides of the mesh are set (mesh_input.h).
 */
#ifndef TRIBOX_POSITIONS_H
#define TRIBOX_POSITIONS_H

#include <string.h>

#include "base/finite.h"
#include "base/floats.h"
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

static inline size_t tribox_position_bytes(const tribox_mesh *mesh)
{
    return mesh->position_bytes == sizeof(double) ? sizeof(double) : sizeof(float);
}

/* The double at any address, less `from_origin`, rounded: the definition of v_local (kernel/README.md). */
static inline float tribox_local_number(const void *from, double from_origin)
{
    double number;
    memcpy(&number, from, sizeof number);
    return (float)(number - from_origin);
}

/* In a mesh that was taken: which stored number is the one of each axis, two bits each. */
#define TRIBOX_AXES_AS_STORED (0u | 1u << 2 | 2u << 4)
static inline size_t tribox_stored_axis(const tribox_mesh *mesh, int a) { return mesh->axes >> 2 * a & 3; }

/* Where the number of axis a of vertex 0 lies. */
static inline const char *tribox_axis_begin(const tribox_mesh *mesh, int a)
{
    return (const char *)mesh->positions + tribox_stored_axis(mesh, a) * mesh->axis_stride;
}

/* A number of either size. */
static inline double tribox_number_read(const tribox_mesh *mesh, const void *from)
{
    double number;
    if (mesh->position_bytes == sizeof number) {
        memcpy(&number, from, sizeof number);
        return number;
    }
    return (double)tribox_float_at(from);
}

/* The position of a vertex, of either size and with any strides. */
static inline void tribox_position_read(const tribox_mesh *mesh, size_t vertex, double to[3])
{
    for (int a = 0; a < 3; a++)
        to[a] = tribox_number_read(mesh, tribox_axis_begin(mesh, a) + vertex * mesh->stride);
}

/* Whether that position is neither NaN nor infinite, from the bits of each number (base/finite.h). */
static inline bool tribox_position_is_finite(const tribox_mesh *mesh, size_t vertex)
{
    bool is_finite = true;
    for (int a = 0; a < 3; a++) {
        const char *const from = tribox_axis_begin(mesh, a) + vertex * mesh->stride;
        is_finite &= mesh->position_bytes == sizeof(double) ? tribox_is_finite_double(tribox_number_read(mesh, from))
                                                            : tribox_is_finite(tribox_float_at(from));
    }
    return is_finite;
}

#endif
