/*
 * frame.h - the frame of an oriented box, q_k = axis_k . (u - center), and a bound on what moving a point into it rounds.
 * After: axes.h. Needs: V_ETA.
 *
 * The bound. d = u - center is rounded once, then three products and two sums are, fused or not: four roundings on the longest
 * path, so |q_k computed - q_k| <= 4.01 u S_k + 3 * 2^-150, S_k = sum over a of |axis_ka| |d_a|. Used is 8 u S_k, from the largest
 * |d_a| of the points that are moved together, plus V_ETA (PROOFS.md 8.1).
 */

#define FRAME_K 8

/* Lanes beyond this, or not finite, are left to integers: below it nothing overflows (PROOFS.md 8.1). */
#define FRAME_LIMIT 0x1p100f

typedef struct lane_frame {
    vnum center[3], axis[3][3], half[3];
} lane_frame;

TRIBOX_INLINE void splat_frame(lane_frame *frame, const tribox_oriented_box *box)
{
    for (int k = 0; k < 3; k++) {
        frame->center[k] = v_splat(box->center[k]);
        frame->half[k] = v_splat(box->half[k]);
        for (int a = 0; a < 3; a++)
            frame->axis[k][a] = v_splat(box->axis[k][a]);
    }
}

TRIBOX_INLINE vnum dot3(const vnum a[3], const vnum b[3]) { return v_fma(a[2], b[2], v_fma(a[1], b[1], v_mul(a[0], b[0]))); }

/* The bound for points whose distances from the center are `most` or less on each axis. */
TRIBOX_INLINE vnum frame_error(const lane_frame *frame, int k, const vnum most[3])
{
    const vnum size[3] = {v_abs(frame->axis[k][0]), v_abs(frame->axis[k][1]), v_abs(frame->axis[k][2])};
    return v_fma(v_splat(FRAME_K * V_UNIT), dot3(size, most), v_splat(V_ETA));
}

/*
 * The lanes of which all that is between two places on axis k of the frame is certainly apart from the box: a rounded number
 * exceeds a float only if the number itself does.
 */
TRIBOX_INLINE vmask apart_in_frame(const lane_frame *frame, int k, vnum least, vnum most, vnum error)
{
    return m_or(v_gt(v_sub(least, error), frame->half[k]), v_gt(v_sub(v_splat(0), frame->half[k]), v_add(most, error)));
}
