/*
 * oriented_pair.h - a triangle and an oriented box in integers: moved into the frame of the box, then tested.
 * After: integers.h.
 */

bool ORIENTED_IN_INTEGERS(const tribox_oriented_integers *in, unsigned axes)
{
    lane_triangle t;
    lane_box box;
    lane_shape s;
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            t.u[j][k] = v_splat(0);
            for (int a = 0; a < 3; a++) {
                const vnum d = v_sub(v_shifted(in->position[3 * a + j]), v_shifted(in->position[9 + a]));
                t.u[j][k] = v_fma(v_shifted(in->axis[3 * k + a]), d, t.u[j][k]);
            }
            t.u[j][k] = v_mul(t.u[j][k], v_shifted((tribox_integer){1, in->shift}));
        }
        const vnum half = v_shifted(in->half[k]);
        set_bounds(&box, k, v_sub(v_splat(0), half), half);
        shape_axis(&s, &t, &box, k);
        if ((axes & TRIBOX_AXES_BOX) && apart_on_box_normal(&t, &box, k))
            return false;
    }
    shape_normal(&s);
    return are_plane_and_edges_touching(&s, axes);
}
