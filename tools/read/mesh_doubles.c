/* mesh_doubles.c - the forms of a mesh as tribox_mesh; rounds doubles to floats. */
#include "mesh_doubles.h"

#include <math.h>
#include <string.h>

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
