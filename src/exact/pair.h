/*
 * pair.h - a triangle and a box in integers, apart on no box normal.
 * After: integers.h.
 */

bool EXACT_IN_INTEGERS(const tribox_integers *in, unsigned axes)
{
    lane_triangle t;
    lane_box box;
    lane_shape s;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            t.u[j][a] = v_shifted(in->number[3 * a + j]);
        set_bounds(&box, a, v_shifted(in->number[9 + a]), v_shifted(in->number[12 + a]));
        shape_axis(&s, &t, &box, a);
    }
    shape_normal(&s);
    return are_plane_and_edges_touching(&s, axes);
}
