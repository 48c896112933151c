/* exact_double.c - the plane and the edge axes in double: certain where a slack exceeds its error bound. */
#include "exact.h"
#include "exact/num_double.h"
#include "kernel/axes.h"
#include "kernel/bounds.h"

/*
 * Given that the box normals do not separate, these axes are redundant and left out, ties and all: the plane when the triangle is
 * flat on an axis, the edges of a projection in which it is flat, an edge parallel to an axis of its projection.
 */
tribox_verdict tribox_exact_double(const tribox_pair *pair, unsigned axes)
{
    lane_triangle t;
    lane_box box;
    lane_shape s;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            t.u[j][a] = pair->u[j][a];
        box.lo[a] = pair->box.lo[a];
        box.hi[a] = pair->box.hi[a];
        box.H[a] = box.hi[a] - box.lo[a];
        shape_axis(&s, &t, &box, a);
    }
    shape_normal(&s);
    const bool has_box = axes & TRIBOX_AXES_BOX;
    const lane_bounds bound = bounds_of(&t, &box);
    const double *const F = bound.F;
    bool is_certain = true;

    for (int i = 0; (axes & TRIBOX_AXES_EDGES) && i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const double error = has_box ? bound.edges[i] : both_sides_bound(&bound, i);
        for (int j = 0; j < 3; j++) {
            if (has_box && (F[a] == 0 || F[b] == 0 || s.f[j][a] == 0 || s.f[j][b] == 0))
                continue;
            const double slack = has_box ? edge_slack(&s, i, j) : edge_slack_both_sides(&s, i, j);
            if (slack < -error)
                return TRIBOX_APART;
            is_certain = is_certain && slack > error;
        }
    }
    if ((axes & TRIBOX_AXES_PLANE) && !(has_box && (F[0] == 0 || F[1] == 0 || F[2] == 0))) {
        const double slack = plane_slack(&s, plane_reach(&s));
        if (slack < -bound.plane)
            return TRIBOX_APART;
        is_certain = is_certain && slack > bound.plane;
    }
    return is_certain ? TRIBOX_OVERLAPPING : TRIBOX_UNDECIDED;
}
