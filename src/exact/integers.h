/* integers.h - the plane and edge axes in integers: the sign of every slack, for certain. Included after axes.h. */

static bool is_negative(vnum slack) { return v_gt(v_splat(0), slack); }

bool EXACT_IN_INTEGERS(const tribox_integers *in, unsigned axes)
{
    lane_triangle t;
    lane_box box;
    lane_shape s;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            t.u[j][a] = v_shifted(in->odd[3 * j + a], in->shift[3 * j + a]);
        box.lo[a] = v_shifted(in->odd[9 + a], in->shift[9 + a]);
        box.hi[a] = v_shifted(in->odd[12 + a], in->shift[12 + a]);
        box.H[a] = v_sub(box.hi[a], box.lo[a]);
        shape_axis(&s, &t, &box, a);
    }
    shape_normal(&s);
    for (int i = 0; (axes & TRIBOX_AXES_EDGES) && i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (is_negative(axes & TRIBOX_AXES_BOX ? edge_slack(&s, i, j) : edge_slack_both_sides(&s, i, j)))
                return false;
    return !(axes & TRIBOX_AXES_PLANE) || !is_negative(plane_slack(&s, plane_reach(&s)));
}
