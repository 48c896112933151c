/*
 * frame.h - triangles moved into the frame of an oriented box, q_k = axis_k . (u - center), and a bound on what that rounds.
 * After: tail.h, axes.h. Needs: V_ETA.
 *
 * The bound. d = u - center is rounded once, then three products and two sums are, fused or not: four roundings on the longest
 * path, so |q_k computed - q_k| <= 4.01 u S_k + 3 * 2^-150, S_k = sum over a of |axis_ka| |d_a|. Used is 8 u S_k, from the largest
 * |d_a| of the three vertices, plus V_ETA (PROOFS.md 8.1).
 */

enum { FRAME_K = 8 };

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

/* A packet moved, and in error[k] the bounds of its lanes. */
TRIBOX_INLINE void move_packet(const tribox_soup *soup, const lane_frame *frame, size_t at, vnum q[3][3], vnum error[3])
{
    vnum d[3][3], most[3];
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            d[j][a] = v_sub(v_load(tribox_soup_axis(soup, a)[j] + at), frame->center[a]);
        most[a] = lane_max3(v_abs(d[0][a]), v_abs(d[1][a]), v_abs(d[2][a]));
    }
    for (int k = 0; k < 3; k++) {
        const vnum size[3] = {v_abs(frame->axis[k][0]), v_abs(frame->axis[k][1]), v_abs(frame->axis[k][2])};
        error[k] = v_fma(v_splat(FRAME_K * V_UNIT), dot3(size, most), v_splat(V_ETA));
        for (int j = 0; j < 3; j++)
            q[j][k] = dot3(frame->axis[k], d[j]);
    }
}

/* The lanes that are certainly apart on the normal of axis k: a rounded number exceeds a float only if the number itself does. */
TRIBOX_INLINE vmask apart_in_frame(const lane_frame *frame, vnum q[3][3], const vnum error[3], int k)
{
    const vnum least = lane_min3(q[0][k], q[1][k], q[2][k]), most = lane_max3(q[0][k], q[1][k], q[2][k]);
    return m_or(v_gt(v_sub(least, error[k]), frame->half[k]), v_gt(v_sub(v_splat(0), frame->half[k]), v_add(most, error[k])));
}

static void to_frame(const tribox_soup *soup, const tribox_oriented_box *box, size_t first, size_t count, tribox_moved *moved)
{
    lane_frame frame;
    packet_run run;
    vnum worst[3] = {v_splat(0), v_splat(0), v_splat(0)};
    splat_frame(&frame, box);
    for (size_t done = 0; done < count; done += run.pairs) {
        const size_t word = done / 64, lane = done % 64;
        vnum q[3][3], error[3];
        vmask apart = m_none(), tame = m_all();
        run = run_of_packets(done, count, V_LANES);
        move_packet(soup, &frame, first + run.at, q, error);
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++)
                v_write(moved->number[3 * k + j] + run.at, q[j][k]);
            apart = m_or(apart, apart_in_frame(&frame, q, error, k));
            tame = m_and(tame, v_gt(v_splat(FRAME_LIMIT), error[k]));
        }
        for (int k = 0; k < 3; k++)
            worst[k] = v_max(worst[k], v_select(m_andnot(tame, apart), error[k], v_splat(0)));
        put_run(&moved->apart[word], lane, m_bits(m_and(apart, tame)), &run);
        put_run(&moved->wild[word], lane, m_bits(tame) ^ LANES_ALL, &run);
    }
    for (int k = 0; k < 3; k++) {
        float lane[V_LANES];
        v_write(lane, worst[k]);
        moved->error[k] = 0;
        for (int i = 0; i < V_LANES; i++)
            moved->error[k] = lane[i] > moved->error[k] ? lane[i] : moved->error[k];
    }
}
