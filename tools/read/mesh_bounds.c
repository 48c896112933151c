/* mesh_bounds.c - the box around the triangles of a mesh. */
#include <math.h>

#include "mesh.h"

static void add_triangle(const double u[9], tribox_box *bounds)
{
    for (int c = 0; c < 9; c++)
        if (!isfinite(u[c]))
            return;
    for (int c = 0; c < 9; c++) {
        bounds->lo[c % 3] = u[c] < bounds->lo[c % 3] ? u[c] : bounds->lo[c % 3];
        bounds->hi[c % 3] = u[c] > bounds->hi[c % 3] ? u[c] : bounds->hi[c % 3];
    }
}

bool mesh_bounds(const mesh *m, tribox_box *bounds)
{
    *bounds = (tribox_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t t = 0; t < m->triangles; t++) {
        double u[9];
        mesh_triangle(m, t, u);
        add_triangle(u, bounds);
    }
    return bounds->lo[0] <= bounds->hi[0];
}
