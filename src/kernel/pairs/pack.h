/*
 * pack.h - triangles that a walk leaves undecided, closed up for the second stage: nine loads and packs a packet, quicker than nine
 * numbers a triangle where a packet has several. After: packet.h.
 */

TRIBOX_INLINE vmask mask_of(uint64_t lanes)
{
    static const int32_t bit_of[TRIBOX_LANES_MAX] = {1 << 0, 1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                                                     1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
    return m_has_bits(i_and(i_load(bit_of), i_splat((int32_t)lanes)));
}

/* Those lanes of the packet from triangle `first` on. */
TRIBOX_INLINE void pack_packet(const tribox_soup *soup, size_t first, uint64_t lanes, tribox_packed *to, size_t at)
{
    const vmask packed = mask_of(lanes);
    for (int a = 0; a < 3; a++)
        for (int j = 0; j < 3; j++)
            v_pack(&to->number[3 * a + j][at], packed, v_load(tribox_soup_axis(soup, a)[j] + first));
}

static void pack(const tribox_soup *soup, size_t count, size_t word, uint64_t lanes, tribox_packed *to, size_t at)
{
    for (size_t lane = 0; lane < 64; lane += V_LANES) {
        const size_t first = 64 * word + lane;
        uint64_t left = lanes >> lane & LANES_ALL;
        if (first + V_LANES <= count) { /* nothing is read after the last */
            pack_packet(soup, first, left, to, at);
            at += tribox_count_bits(left);
            continue;
        }
        for (; left; left &= left - 1, at++)
            for (int k = 0; k < 9; k++)
                to->number[k][at] = tribox_float_at(tribox_soup_axis(soup, k / 3)[k % 3] + first + tribox_lowest_bit(left));
    }
}
