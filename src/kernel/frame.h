/*
 * frame.h - the frame of an oriented box, q_k = axis_k . (u - center), and a bound on what moving a point into it rounds.
 * After: axes.h.
 *
 * The bound. d = u - center is rounded once, here or before, and axis_ka was, once a box; then three products and two sums are,
 * fused or not: five roundings on the longest path, so |q_k computed - q_k| <= 5.01 u S_k + 3 * 2^-150, S_k = sum over a of
 * |axis_ka| |d_a|. Used is 8 u S_k, from the largest |d_a| of the points that are moved together, plus what may underflow
 * (PROOFS.md 8.1).
 */

#define FRAME_K 8

/* Lanes beyond this, or not finite, are left to integers: below it nothing overflows (PROOFS.md 8.1). */
#define FRAME_LIMIT 0x1p100f

typedef struct lane_frame {
    vnum center[3], axis[3][3], size[3][3], lost[3];
    vnum near[3], outer_lo[3], outer_hi[3], inner_lo[3], inner_hi[3];
} lane_frame;

TRIBOX_INLINE void splat_frame(lane_frame *frame, const tribox_rounded_frame *box)
{
    for (int k = 0; k < 3; k++) {
        frame->center[k] = v_splat(box->center[k]);
        frame->lost[k] = v_splat(box->lost[k]);
        frame->near[k] = v_splat(box->near[k]);
        frame->outer_lo[k] = v_splat(box->outer_lo[k]);
        frame->outer_hi[k] = v_splat(box->outer_hi[k]);
        frame->inner_lo[k] = v_splat(box->inner_lo[k]);
        frame->inner_hi[k] = v_splat(box->inner_hi[k]);
        for (int a = 0; a < 3; a++) {
            frame->axis[k][a] = v_splat(box->axis[k][a]);
            frame->size[k][a] = v_splat(box->size[k][a]);
        }
    }
}

TRIBOX_INLINE vnum dot3(const vnum a[3], const vnum b[3]) { return v_fma(a[2], b[2], v_fma(a[1], b[1], v_mul(a[0], b[0]))); }

/* The bound for points whose distances from the center are `most` or less on each axis. */
TRIBOX_INLINE vnum frame_error(const lane_frame *frame, int k, const vnum most[3])
{
    return v_fma(v_splat(FRAME_K * V_UNIT), dot3(frame->size[k], most), frame->lost[k]);
}

/*
 * The lanes of which all that is between two places on axis k of the frame is certainly apart from the box: a rounded number
 * exceeds a float only if the number itself does.
 */
TRIBOX_INLINE vmask apart_in_frame(const lane_frame *frame, int k, vnum least, vnum most, vnum error)
{
    return m_or(v_gt(v_sub(least, error), frame->outer_hi[k]), v_gt(frame->outer_lo[k], v_add(most, error)));
}
