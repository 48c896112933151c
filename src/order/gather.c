/* gather.c - triangles in any order as nine streams. */
#include <string.h>

#include "base/environment.h"
#include "base/floats.h"
#include "mesh/mesh_input.h"
#include "mesh/positions.h"
#include "base/soup.h"

/* Triangles that are copied stream by stream: what they touch stays in the cache. */
enum { BLOCK = 1024 };

static bool is_writable(const uint32_t *order, size_t first, size_t count, float *const x[3], float *const y[3], float *const z[3])
{
    if (first > SIZE_MAX - count || !tribox_is_addressable(first + count) || !x || !y || !z)
        return false;
    bool is_given = order;
    for (int v = 0; v < 3; v++)
        is_given &= x[v] && y[v] && z[v];
    return !count || is_given;
}

/* Whether an order names triangles below `limit` alone. */
static bool is_order(const uint32_t *order, size_t count, size_t limit)
{
    uint32_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        greatest = order[i] > greatest ? order[i] : greatest;
    return !count || greatest < limit;
}

tribox_status tribox_soup_gather(const tribox_soup *soup, const uint32_t *order, size_t first, size_t count, float *const x[3],
                                 float *const y[3], float *const z[3])
{
    if (!tribox_soup_is_readable(soup) || !is_writable(order, first, count, x, y, z))
        return TRIBOX_BAD_ARGUMENT;
    if (count && !is_order(order + first, count, soup->count))
        return TRIBOX_BAD_VERTEX;
    float *const *const to[3] = {x, y, z};
    for (size_t start = 0; start < count; start += BLOCK)
        for (int k = 0; k < 9; k++) {
            const float *const stream = tribox_soup_axis(soup, k / 3)[k % 3];
            for (size_t i = start; i < count && i < start + BLOCK; i++)
                memcpy(&to[k / 3][k % 3][i], &stream[order[first + i]], sizeof(float));
        }
    return TRIBOX_OK;
}

/* Whether the triangles that an order names have vertices of the mesh alone. */
static bool are_vertices_there(const tribox_mesh *mesh, const uint32_t *order, size_t count)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    bool are = true;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++)
            are &= tribox_vertex_number(mesh, bytes, 3 * (size_t)order[i] + v) < mesh->vertices;
    return are;
}

/* Numbers as they are. */
static void copy_vertex(const tribox_mesh *mesh, size_t vertex, float *const to[3])
{
    const char *const from = (const char *)mesh->positions + vertex * mesh->stride;
    for (size_t a = 0; a < 3; a++)
        memcpy(to[a], from + a * sizeof(float), sizeof(float));
}

tribox_status tribox_mesh_gather(const tribox_mesh *mesh, const double origin[3], const uint32_t *order, size_t first, size_t count,
                                 float *const x[3], float *const y[3], float *const z[3])
{
    tribox_mesh strided;
    double from[3];
    if (!tribox_mesh_take(mesh, &strided) || !tribox_mesh_origin_of(origin, from) || !is_writable(order, first, count, x, y, z))
        return TRIBOX_BAD_ARGUMENT;
    const unsigned bytes = tribox_vertex_bytes(mesh);
    const bool is_copied = !origin && tribox_mesh_has_floats(&strided);
    if (count && (!is_order(order + first, count, mesh->count) || !are_vertices_there(mesh, order + first, count)))
        return TRIBOX_BAD_VERTEX;
    const tribox_environment callers = tribox_environment_enter();
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t vertex = tribox_vertex_number(mesh, bytes, 3 * (size_t)order[first + i] + v);
            double u[3];
            if (is_copied) {
                copy_vertex(&strided, vertex, (float *const[3]){&x[v][i], &y[v][i], &z[v][i]});
                continue;
            }
            tribox_position_read(&strided, vertex, u);
            tribox_float_put(x[v] + i, u[0] - from[0]);
            tribox_float_put(y[v] + i, u[1] - from[1]);
            tribox_float_put(z[v] + i, u[2] - from[2]);
        }
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
