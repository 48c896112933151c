/* ordered_mesh.c - a second set of streams takes the place of the first. */
#include "ordered_mesh.h"

#include <stdlib.h>

#include "console/memory.h"

enum { SCRATCH_BYTES = 16 /* a triangle, for tribox_soup_sort */ };

static bool find_order(const tribox_soup *soup, uint32_t *order)
{
    void *const scratch = malloc(soup->count * SCRATCH_BYTES);
    const bool is_found = scratch && !tribox_soup_sort(soup, order, scratch);
    free(scratch);
    return is_found;
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

static bool gather(mesh *m, const uint32_t *order)
{
    const size_t count = m->soup.count;
    float *const coordinates = malloc(9 * count * sizeof *coordinates);
    float *streams[9];
    tribox_soup ordered;
    if (!coordinates)
        return false;
    point_streams(coordinates, count, streams, &ordered);
    if (tribox_soup_gather(&m->soup, order, 0, count, streams, streams + 3, streams + 6)) {
        free(coordinates);
        return false;
    }
    free(m->coordinates);
    m->coordinates = coordinates;
    m->capacity = count;
    m->soup = ordered;
    return true;
}

uint32_t *mesh_order(mesh *m)
{
    const size_t triangle_bytes = 9 * sizeof(float) + sizeof(uint32_t);
    if (m->soup.count > memory_available() / triangle_bytes)
        return NULL;
    uint32_t *order = malloc(m->soup.count * sizeof *order);
    if (order && (!find_order(&m->soup, order) || !gather(m, order))) {
        free(order);
        order = NULL;
    }
    return order;
}
