/* same_mesh.c - triangles, numbers and bounds of two meshes. */
#include "same_mesh.h"

#include <math.h>
#include <string.h>

bool mesh_is_same(const mesh *a, const mesh *b)
{
    bool same = a->triangles == b->triangles && a->is_double == b->is_double && a->left_out == b->left_out &&
                a->miscut == b->miscut && a->seen.not_finite == b->seen.not_finite &&
                a->seen.first_not_finite == b->seen.first_not_finite && a->doubles.vertices == b->doubles.vertices &&
                !memcmp(&a->seen.bounds, &b->seen.bounds, sizeof a->seen.bounds);
    for (size_t t = 0; same && t < a->triangles; t++) {
        double u[9], v[9];
        mesh_triangle(a, t, u);
        mesh_triangle(b, t, v);
        same = !memcmp(u, v, sizeof u);
    }
    return same;
}

bool mesh_is_looked_at_well(const mesh *m)
{
    tribox_box bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    size_t not_finite = 0, first = m->triangles;
    for (size_t t = 0; t < m->triangles; t++) {
        double u[9];
        bool is_finite = true;
        mesh_triangle(m, t, u);
        for (int c = 0; c < 9; c++)
            is_finite &= isfinite(u[c]) != 0;
        first = is_finite || not_finite ? first : t;
        not_finite += !is_finite;
        for (int c = 0; is_finite && c < 9; c++) {
            bounds.lo[c % 3] = u[c] < bounds.lo[c % 3] ? u[c] : bounds.lo[c % 3];
            bounds.hi[c % 3] = u[c] > bounds.hi[c % 3] ? u[c] : bounds.hi[c % 3];
        }
    }
    return not_finite == m->seen.not_finite && first == m->seen.first_not_finite &&
           !memcmp(&bounds, &m->seen.bounds, sizeof bounds);
}
