/*
 * sides.h - the plane and edge axes by orientations of points of the input, of which only the signs are asked (PROOFS.md 9.1).
 * After: a type `exact_points`, and the signs of
 *   sign_of_length(p, j, a)          f_ja
 *   sign_of_normal(p, i)             n_i
 *   sign_of_side(p, i, j, k, X)      m . (u_k - X) in projection i, with m = (f_jb, -f_ja), the normal of edge j, and X a corner
 *   sign_of_height(p, X)             n . (u_0 - X), X a corner
 * A corner has TRIBOX_LO or TRIBOX_HI for each axis, in a projection first for a and then for b.
 */

/*
 * Where the corner that is least along a direction lies on an axis, by the sign that the direction has there; at zero either will
 * do.
 */
TRIBOX_INLINE int least_along(int sign) { return sign > 0 ? TRIBOX_LO : TRIBOX_HI; }
TRIBOX_INLINE int greatest_along(int sign) { return sign > 0 ? TRIBOX_HI : TRIBOX_LO; }

/* With the box normals one side is enough: the sign of n_i says which. */
TRIBOX_INLINE bool is_edge_touching(const exact_points *p, int i, int j, bool is_box_asked)
{
    const int a = (i + 1) % 3, b = (i + 2) % 3, k = (j + 2) % 3;
    const int m_a = sign_of_length(p, j, b), m_b = -sign_of_length(p, j, a);
    const int least[2] = {least_along(m_a), least_along(m_b)}, greatest[2] = {greatest_along(m_a), greatest_along(m_b)};
    if (is_box_asked)
        return sign_of_normal(p, i) < 0 ? sign_of_side(p, i, j, j, greatest) <= 0 : sign_of_side(p, i, j, j, least) >= 0;
    return (sign_of_side(p, i, j, j, least) >= 0 || sign_of_side(p, i, j, k, least) >= 0) &&
           (sign_of_side(p, i, j, j, greatest) <= 0 || sign_of_side(p, i, j, k, greatest) <= 0);
}

TRIBOX_INLINE bool is_plane_touching(const exact_points *p)
{
    int least[3], greatest[3];
    for (int i = 0; i < 3; i++) {
        least[i] = least_along(sign_of_normal(p, i));
        greatest[i] = greatest_along(sign_of_normal(p, i));
    }
    return sign_of_height(p, least) >= 0 && sign_of_height(p, greatest) <= 0;
}

TRIBOX_INLINE bool are_sides_touching(const exact_points *p, unsigned axes)
{
    for (int i = 0; (axes & TRIBOX_AXES_EDGES) && i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (!is_edge_touching(p, i, j, axes & TRIBOX_AXES_BOX))
                return false;
    return !(axes & TRIBOX_AXES_PLANE) || is_plane_touching(p);
}
