/* mesh_room.c - the forms of a mesh, floats on large pages or doubles, which become floats; and what a user should know of it. */
#include "mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/system.h"
#include "mesh_file.h"

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

int mesh_make_room(const char *path, uint64_t count, mesh *m)
{
    float *const coordinates = count && count <= SIZE_MAX / TRIANGLE_BYTES ? pages_take((size_t)count * TRIANGLE_BYTES) : NULL;
    if (coordinates)
        point_streams(coordinates, (size_t)count, m);
    if (coordinates || !path)
        return coordinates ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
    return count ? message_failure("%s: out of memory for %" PRIu64 " triangles" MESH_TO_SORT, path, count)
                 : message_failure("%s: contains no triangles (points or lines at most); give a mesh with faces", path);
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

void mesh_set_doubles(double *positions, size_t vertices, uint32_t *corners, size_t triangles, mesh *m)
{
    mesh_drop_floats(m);
    m->positions = positions;
    m->corners = corners;
    m->is_double = true;
    m->triangles = triangles;
    m->doubles = (tribox_mesh){.positions = positions,
                               .vertices = vertices,
                               .indices = corners,
                               .index_bytes = sizeof *corners,
                               .count = triangles,
                               .position_bytes = sizeof *positions};
}

void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first)
{
    if (not_finite)
        message_say("warning: %s: %" PRIu64 " of %" PRIu64
                    " triangles have NaN or infinite coordinates and overlap nothing; the first is number %" PRIu64,
                    path, not_finite, count, first);
}

void mesh_warn_rounded(const char *path, const mesh *m)
{
    if (m->rounded)
        message_say("warning: %s: rounding to float moved coordinates of %zu vert%s by up to %.2g", path, m->rounded,
                    m->rounded == 1 ? "ex" : "ices", m->moved);
}

void mesh_warn(const char *path, const mesh *m)
{
    mesh_warn_not_finite(path, m->not_finite, m->triangles, m->first_not_finite);
    mesh_warn_rounded(path, m);
    if (m->uncut)
        message_say("warning: %s: %zu of %zu triangles are missing: libassimp cannot cut polygons that cross themselves", path,
                    m->uncut, m->soup.count + m->uncut);
    if (m->miscut)
        message_say("warning: %s: %zu polygon%s cannot be cut well, so the triangles cover too much; triangulate the mesh first",
                    path, m->miscut, m->miscut == 1 ? "" : "s");
}
