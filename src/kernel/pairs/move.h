/*
 * move.h - triangles of a soup, moved into the frame of an oriented box.
 * After: tail.h, axes.h, frame.h.
 */

/* A packet moved, and in error[k] the bounds of its lanes. Returns those that reach beyond `near` on an axis of space. */
TRIBOX_INLINE vmask move_packet(const tribox_soup *soup, const lane_frame *frame, size_t at, vnum q[3][3], vnum error[3])
{
    vnum d[3][3], most[3];
    vmask far = m_none();
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            d[j][a] = v_sub(v_load(tribox_soup_axis(soup, a)[j] + at), frame->center[a]);
        most[a] = lane_max3(v_abs(d[0][a]), v_abs(d[1][a]), v_abs(d[2][a]));
        far = m_or(far, v_gt(most[a], frame->near[a]));
    }
    for (int k = 0; k < 3; k++) {
        error[k] = frame_error(frame, k, most);
        for (int j = 0; j < 3; j++)
            q[j][k] = dot3(frame->axis[k], d[j]);
    }
    return far;
}

static void to_frame(const tribox_soup *soup, const tribox_rounded_frame *box, size_t first, size_t count, tribox_moved *moved)
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
        const vmask far = move_packet(soup, &frame, first + run.at, q, error);
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++)
                v_write(moved->number[3 * k + j] + run.at, q[j][k]);
            apart = m_or(apart, apart_in_frame(&frame, k, lane_min3(q[0][k], q[1][k], q[2][k]),
                                               lane_max3(q[0][k], q[1][k], q[2][k]), error[k]));
            tame = m_and(tame, v_gt(v_splat(FRAME_LIMIT), error[k]));
        }
        for (int k = 0; k < 3; k++)
            worst[k] = v_max(worst[k], v_select(m_andnot(tame, m_or(apart, far)), error[k], v_splat(0)));
        put_run(&moved->apart[word], lane, m_bits(m_and(apart, tame)), &run);
        put_run(&moved->wild[word], lane, m_bits(tame) ^ LANES_ALL, &run);
        put_run(&moved->far[word], lane, m_bits(m_andnot(m_and(tame, far), apart)), &run);
    }
    for (int k = 0; k < 3; k++) {
        float lane[V_LANES];
        v_write(lane, worst[k]);
        moved->error[k] = 0;
        for (int i = 0; i < V_LANES; i++)
            moved->error[k] = lane[i] > moved->error[k] ? lane[i] : moved->error[k];
    }
}
