/*
 * inside.h - which triangles, and which words of them, lie wholly in the box: all three vertices do, as the box is convex. Input
 * numbers are compared: exact. After: tail.h, axes.h, packet.h.
 */

/* The lanes of `left` that lie in the box on axis a of the packet at triangle `at`. */
TRIBOX_INLINE uint64_t inside_on_axis(const tribox_soup *soup, const lane_box *box, size_t at, int a, uint64_t left, walk_kind kind)
{
    const float *const *const stream = tribox_soup_axis(soup, a);
    const vnum u0 = load_stream(stream[0] + at, soup->count, kind), u1 = load_stream(stream[1] + at, soup->count, kind),
               u2 = load_stream(stream[2] + at, soup->count, kind);
    const vmask is_finite = v_is_zero(lane_lost3(u0, u1, u2));
    const vmask is_beyond = m_or(v_gt(box->lo[a], lane_min3(u0, u1, u2)), v_gt(lane_max3(u0, u1, u2), box->hi[a]));
    return left & m_bits(m_andnot(is_finite, is_beyond));
}

TRIBOX_INLINE void splat_bounds(lane_box *lanes, const tribox_rounded_box *box)
{
    for (int a = 0; a < 3; a++) {
        lanes->lo[a] = v_splat(box->lo[a]);
        lanes->hi[a] = v_splat(box->hi[a]);
    }
}

TRIBOX_NOINLINE uint64_t inside_of_packets(const tribox_soup *soup, const tribox_rounded_box *box, size_t word, uint64_t candidates)
{
    uint64_t found = 0;
    lane_box lanes;
    splat_bounds(&lanes, box);
    for (size_t lane = 0; lane < 64 && 64 * word + lane < soup->count; lane += V_LANES) {
        const packet_run run = run_of_packets(64 * word + lane, soup->count, V_LANES);
        uint64_t left = candidates >> lane << run.repeated & LANES_ALL;
        for (int a = 0; left && a < 3; a++)
            left = inside_on_axis(soup, &lanes, run.at, a, left, 0);
        found |= bits_of_run(left, &run) << lane;
    }
    return found;
}

/* Of a soup of fewer than V_LANES: nothing past them is read. */
TRIBOX_NOINLINE uint64_t inside_of_few(const tribox_soup *soup, const tribox_rounded_box *box, uint64_t candidates)
{
    lane_box lanes;
    splat_bounds(&lanes, box);
    candidates &= LANES_ALL >> (V_LANES - soup->count);
    for (int a = 0; candidates && a < 3; a++)
        candidates = inside_on_axis(soup, &lanes, 0, a, candidates, WALKS_FEW);
    return candidates;
}

static uint64_t inside(const tribox_soup *soup, const tribox_rounded_box *box, size_t word, uint64_t candidates)
{
    return soup->count < V_LANES ? inside_of_few(soup, box, candidates) : inside_of_packets(soup, box, word, candidates);
}

/*
 * How many words from triangle `at` on, of those before triangle `end`, lie wholly in the box. A sum shows what is not finite for
 * less (PROOFS.md 5.4); one that overflows ends them early.
 */
TRIBOX_NOINLINE size_t words_inside(const tribox_soup *soup, const tribox_rounded_box *box, size_t at, size_t end)
{
    lane_box lanes;
    splat_bounds(&lanes, box);
    size_t words = 0;
    for (; end - at >= 64; words++, at += 64) {
        vnum sum = v_splat(0);
        for (size_t lane = 0; lane < 64; lane += V_LANES)
            for (int a = 0; a < 3; a++) {
                const float *const *const stream = tribox_soup_axis(soup, a);
                const vnum u0 = v_load(stream[0] + at + lane), u1 = v_load(stream[1] + at + lane),
                           u2 = v_load(stream[2] + at + lane);
                if (m_bits(m_or(v_gt(lanes.lo[a], lane_min3(u0, u1, u2)), v_gt(lane_max3(u0, u1, u2), lanes.hi[a]))))
                    return words;
                sum = v_add(sum, v_add(u0, v_add(u1, u2)));
            }
        if (m_bits(v_gt(v_splat(INFINITY), v_abs(sum))) != LANES_ALL)
            return words;
    }
    return words;
}
