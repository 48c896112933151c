/* mesh_doubles.c - the forms of a mesh as tribox_mesh; rounds doubles to floats, and looks for those that are not finite. */
#include "mesh_doubles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void mesh_set_doubles(double *positions, size_t vertices, uint32_t *corners, size_t triangles, mesh *m)
{
    free(m->coordinates);
    m->coordinates = NULL;
    m->capacity = 0;
    m->soup = (tribox_soup){.count = 0};
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

/* Number i of the floats ends before number i + 1 of the doubles begins. */
static double round_number(unsigned char *bytes, size_t i, double origin)
{
    double number;
    memcpy(&number, bytes + i * sizeof number, sizeof number);
    const double relative = number - origin;
    const float nearest = (float)relative;
    memcpy(bytes + i * sizeof nearest, &nearest, sizeof nearest);
    return isfinite(nearest) ? fabs(relative - (double)nearest) : 0;
}

void mesh_round(const double origin[3], mesh *m)
{
    for (size_t v = 0; v < m->doubles.vertices; v++) {
        double most = 0;
        for (size_t a = 0; a < 3; a++)
            most = fmax(most, round_number(m->positions, 3 * v + a, origin[a]));
        m->rounded += most > 0;
        m->moved = fmax(m->moved, most);
    }
}

static bool is_finite(const double *position) { return isfinite(position[0]) && isfinite(position[1]) && isfinite(position[2]); }

static bool is_finite_triangle(const mesh *m, size_t t)
{
    const double *const positions = m->positions;
    bool is_sound = true;
    for (size_t v = 3 * t; v < 3 * t + 3; v++)
        is_sound &= is_finite(positions + 3 * (m->corners ? m->corners[v] : v));
    return is_sound;
}

size_t mesh_doubles_not_finite(const mesh *m, size_t *first)
{
    const double *const positions = m->positions;
    size_t vertex = 0, count = 0;
    *first = m->doubles.count;
    while (vertex < m->doubles.vertices && is_finite(positions + 3 * vertex))
        vertex++;
    for (size_t t = m->doubles.count; vertex < m->doubles.vertices && t > 0; t--)
        if (!is_finite_triangle(m, t - 1)) {
            count++;
            *first = t - 1;
        }
    return count;
}
