/* mesh_room.c - the room for triangles as floats, on large pages: nine streams, one after the other. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/pages.h"
#include "double_triangles.h"
#include "mesh.h"

enum { TRIANGLE_BYTES = 9 * sizeof(float) };

void mesh_streams(const mesh *m, size_t first, float *to[9])
{
    for (size_t k = 0; k < 9; k++)
        to[k] = m->coordinates + k * m->capacity + first;
}

static void point_streams(float *coordinates, size_t capacity, mesh *m)
{
    m->coordinates = coordinates;
    m->capacity = capacity;
    for (size_t v = 0; v < 3; v++) {
        m->soup.x[v] = coordinates + v * capacity;
        m->soup.y[v] = coordinates + (3 + v) * capacity;
        m->soup.z[v] = coordinates + (6 + v) * capacity;
    }
}

bool mesh_take_room(uint64_t count, mesh *m)
{
    float *const coordinates = count <= SIZE_MAX / TRIANGLE_BYTES ? pages_take((size_t)count * TRIANGLE_BYTES) : NULL;
    if (coordinates)
        point_streams(coordinates, (size_t)count, m);
    return coordinates;
}

int mesh_make_room(const char *path, uint64_t count, mesh *m)
{
    if (!count)
        return message_failure("%s: contains no triangles (points or lines at most); give a mesh with faces", path);
    return mesh_take_room(count, m) ? EXIT_CODE_OK : message_failure("%s: out of memory for %" PRIu64 " triangles", path, count);
}

int mesh_more_room(const char *name, mesh *m)
{
    uint64_t capacity;
    const int code = triangles_more_room(name, m->soup.count, m->capacity, TRIANGLE_BYTES, &capacity);
    if (code)
        return code;
    float *const grown = pages_take((size_t)capacity * TRIANGLE_BYTES);
    if (!grown)
        return message_failure("%s: out of memory after %zu triangles", name, m->soup.count);
    for (size_t k = 0; k < 9 && m->soup.count; k++)
        memcpy(grown + k * capacity, m->coordinates + k * m->capacity, m->soup.count * sizeof *grown);
    pages_free(m->coordinates, m->capacity * TRIANGLE_BYTES);
    point_streams(grown, (size_t)capacity, m);
    return EXIT_CODE_OK;
}

void mesh_drop_floats(mesh *m)
{
    pages_free(m->coordinates, m->capacity * TRIANGLE_BYTES);
    m->coordinates = NULL;
    m->capacity = 0;
    m->soup = (tribox_soup){.count = 0};
}

void mesh_free(mesh *m)
{
    mesh_drop_floats(m);
    free(m->positions);
    free(m->corners);
    free(m->opened);
    *m = (mesh){.coordinates = NULL};
}
