/*
 * integers.h - the plane and edge axes in integers: the sign of every slack, for certain.
 * After: kernel/axes.h.
 */

static bool is_negative(vnum slack) { return v_gt(v_splat(0), slack); }

static bool are_plane_and_edges_touching(const lane_shape *s, unsigned axes)
{
    for (int i = 0; (axes & TRIBOX_AXES_EDGES) && i < 3; i++) {
        const edge_slacks slack = edge_slacks_along(s, i, axes & TRIBOX_AXES_BOX);
        for (int j = 0; j < 3; j++)
            if (is_negative(slack.of[j]))
                return false;
    }
    return !(axes & TRIBOX_AXES_PLANE) || !is_negative(plane_slack(s, plane_reach(s)));
}
