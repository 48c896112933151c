/*
 * margin.h - the bounds of bounds.h, cheaper and coarser, for float: one for all nine edge axes and one for the plane.
 * After: axes.h. Needs: V_ETA, V_EXTENT.
 *
 * Both come from the sum of the extents. With s = F_x + F_y + F_z and h the longest side of the box, PROOFS.md 4 has
 *   B_i <= s s / 2 + s h     S <= s s s / 9 + h s s / 3 + tau (s + 3 h)
 * for the lanes that the box normals leave. So the bound on the plane, 48 u S, is at most s times that on the edges, 32 u B_i,
 * but for tau; 34 in place of 32 makes room for the roundings of these lines. s is taken as sigma >= s, the sum over the axes of
 * |f_0a| + |f_1a|, which is not finite if any coordinate is not.
 *
 * Where the box normals are not tested, h grows by the sum of the |V_a| (PROOFS.md 4.5).
 */
typedef struct lane_margin {
    vmask is_valid; /* finite, and small enough that no product overflows (PROOFS.md 4.6) */
    vnum edges, plane;
} lane_margin;

/* The terms of a margin that come from the box alone. */
typedef struct lane_box_margin {
    vnum most;  /* of sigma */
    vnum least; /* of every |f_0a| + |f_1a| but zero, for a certificate of overlap: at most 0 where extents do not matter */
    vnum edges; /* of the coefficient of sigma */
    vnum eta;   /* of the plane, tau included */
} lane_box_margin;

/*
 * The certificate needs F_a >= 2^-55, but only where a bound of the box lies between the least and the greatest u_ja or is one of
 * them: elsewhere the box spans the triangle on axis a, and no edge separates in a projection that has it. Two floats less than
 * 2^-55 apart are below 2^-31, so for a box without a bound that small, extents do not matter: the result is then at most 0
 * (PROOFS.md 5.2). With V_EXTENT = 2^-54 and the unit of any float, 2^-31 is half of it over the unit; the factor 2^60 has only to
 * be 2 or more.
 */
TRIBOX_INLINE vnum least_extent(const lane_box *box)
{
    const vnum nearest = v_min(lane_min3(v_abs(box->lo[0]), v_abs(box->lo[1]), v_abs(box->lo[2])),
                               lane_min3(v_abs(box->hi[0]), v_abs(box->hi[1]), v_abs(box->hi[2])));
    return v_min(v_mul(v_sub(v_splat(V_EXTENT / (2 * V_UNIT)), nearest), v_splat(0x1p60f)), v_splat(V_EXTENT));
}

/*
 * V_ETA + 2^-125 times a length, 2^-125 being V_ETA / 32: from a normal product, as one that underflows takes a hundred cycles
 * where nothing is fused.
 */
TRIBOX_INLINE vnum tau_of(vnum length) { return v_mul(v_add(length, v_splat(32)), v_splat(V_ETA / 32)); }

TRIBOX_INLINE lane_box_margin box_margin_of(const lane_box *box)
{
    const vnum h = lane_max3(box->H[0], box->H[1], box->H[2]);
    return (lane_box_margin){
        .most = v_sub(v_splat(0x1p38f), h),
        .least = least_extent(box),
        .edges = v_mul(h, v_splat(34 * V_UNIT)),
        .eta = tau_of(h),
    };
}

/* The same, for a triangle that may be anywhere. */
TRIBOX_INLINE lane_box_margin widened(const lane_box_margin *box, const lane_shape *s)
{
    const vnum away = v_add(v_add(v_abs(s->V[0]), v_abs(s->V[1])), v_abs(s->V[2]));
    return (lane_box_margin){
        .most = v_sub(box->most, away),
        .least = box->least,
        .edges = v_fma(away, v_splat(34 * V_UNIT), box->edges),
        .eta = v_add(box->eta, tau_of(away)),
    };
}

/* At least F_a, at most twice it, and zero where F_a is: as a sum of magnitudes it cannot lose a NaN, as min and max can. */
TRIBOX_INLINE vnum extent_sum(const lane_shape *s, int a) { return v_add(v_abs(s->f[0][a]), v_abs(s->f[1][a])); }

TRIBOX_INLINE lane_margin margin_of(const lane_shape *s, const lane_box_margin *from, bool is_box_asked)
{
    const lane_box_margin box = is_box_asked ? *from : widened(from, s);
    const vnum sigma = v_add(v_add(extent_sum(s, 0), extent_sum(s, 1)), extent_sum(s, 2));
    const vnum edges = v_fma(sigma, v_fma(sigma, v_splat(17 * V_UNIT), box.edges), v_splat(V_ETA));
    return (lane_margin){
        .is_valid = v_gt(box.most, sigma),
        .edges = edges,
        .plane = v_fma(sigma, edges, box.eta),
    };
}
