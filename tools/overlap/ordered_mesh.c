/* ordered_mesh.c - a second set of streams, or of vertex numbers, takes the place of the first. */
#include "ordered_mesh.h"

#include <stdlib.h>

#include "by_threads.h"
#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"

enum { SCRATCH_BYTES = 16 /* a triangle, for an order */ };

static bool find_order(const mesh *m, unsigned threads, uint32_t *order)
{
    const size_t bytes = m->triangles * SCRATCH_BYTES;
    void *const scratch = pages_take(bytes);
    const tribox_status status = scratch ? sort_by_threads(m, threads, order, scratch) : MESSAGE_NO_MEMORY;
    pages_free(scratch, bytes);
    return !status;
}

/* The streams of so many triangles, one after the other: x of the three vertices, then y, then z. */
static void point_streams(float *coordinates, size_t count, float *streams[9], tribox_soup *soup)
{
    for (size_t k = 0; k < 9; k++)
        streams[k] = coordinates + k * count;
    for (size_t v = 0; v < 3; v++) {
        soup->x[v] = streams[v];
        soup->y[v] = streams[3 + v];
        soup->z[v] = streams[6 + v];
    }
    soup->count = count;
}

static bool gather_streams(mesh *m, unsigned threads, const uint32_t *order)
{
    const size_t count = m->soup.count;
    float *const coordinates = pages_take(9 * count * sizeof *coordinates);
    float *streams[9];
    tribox_soup ordered;
    if (!coordinates)
        return false;
    point_streams(coordinates, count, streams, &ordered);
    if (gather_by_threads(&m->soup, order, threads, streams)) {
        pages_free(coordinates, 9 * count * sizeof *coordinates);
        return false;
    }
    mesh_drop_floats(m);
    m->coordinates = coordinates;
    m->capacity = count;
    m->soup = ordered;
    return true;
}

/* Positions stay where they are. */
static bool reorder_corners(mesh *m, const uint32_t *order)
{
    uint32_t *const corners = malloc(3 * m->triangles * sizeof *corners);
    if (!corners)
        return false;
    for (size_t i = 0; i < m->triangles; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t corner = 3 * (size_t)order[i] + v;
            corners[3 * i + v] = m->corners ? m->corners[corner] : (uint32_t)corner;
        }
    free(m->corners);
    m->corners = corners;
    m->doubles.indices = corners;
    m->doubles.index_bytes = sizeof *corners;
    return true;
}

uint32_t *mesh_order(mesh *m, unsigned threads)
{
    const size_t triangle_bytes = 9 * sizeof(float) + sizeof(uint32_t);
    if (m->triangles > memory_available() / triangle_bytes || (m->is_double && m->doubles.vertices > UINT32_MAX))
        return NULL;
    uint32_t *order = malloc(m->triangles * sizeof *order);
    if (order &&
        (!find_order(m, threads, order) || !(m->is_double ? reorder_corners(m, order) : gather_streams(m, threads, order)))) {
        free(order);
        order = NULL;
    }
    return order;
}
