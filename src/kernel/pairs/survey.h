/*
 * survey.h - a word of a soup, walked in order 123, which also says what groups of axes reject whole packets: choice.c finds the
 * order from it.
 * After: packet.h.
 *
 * A packet is left as early as in a walk: what it would cost to know the rest of it is more than the choice could gain.
 */

/* Notes the sets of groups that leave no lane of a packet, from the lanes that each group leaves. */
TRIBOX_INLINE void note_rejected(tribox_seen *seen, uint64_t packet, uint64_t box, uint64_t plane, uint64_t edges)
{
    const uint64_t left[] = {box, plane, box & plane, edges, box & edges, plane & edges};
    for (int k = 0; k < 6; k++)
        seen->rejected[k + 1] |= left[k] ? 0 : packet;
}

TRIBOX_INLINE uint64_t survey_by_sign(const lane_shape *s, walk_kind kind, uint64_t packet, uint64_t left, tribox_seen *seen,
                                      uint64_t *undecided)
{
    vmask finite;
    const uint64_t plane = left_by_plane_sign(s, LANES_ALL, &finite);
    const bool is_left = left & plane;
    const uint64_t edges = is_left ? left_by_edge_signs(s, kind, LANES_ALL, &finite) : LANES_ALL;
    note_rejected(seen, packet, left, plane, edges);
    *undecided = left & plane & edges & ~m_bits(finite);
    return left & plane & edges & m_bits(finite);
}

TRIBOX_INLINE uint64_t survey_by_margin(const lane_pairs *p, const lane_shape *s, walk_kind kind, uint64_t packet, uint64_t left,
                                        tribox_seen *seen, uint64_t *undecided)
{
    lane_margin margin;
    vmask certain;
    const uint64_t plane = left_by_margin(p, s, 2, true, kind, LANES_ALL, &margin, &certain);
    const bool is_left = left & plane;
    const uint64_t edges = is_left ? left_by_margin(p, s, 3, false, kind, LANES_ALL, &margin, &certain) : LANES_ALL;
    note_rejected(seen, packet, left, plane, edges);
    const uint64_t hit = is_left ? certain_overlaps(s, &p->margin, &margin, certain, kind, left & plane & edges) : 0;
    *undecided = left & plane & edges & ~hit;
    return hit;
}

TRIBOX_INLINE uint64_t survey_packet(lane_pairs *p, const tribox_query *from, size_t at, walk_kind kind, uint64_t packet,
                                     tribox_seen *seen, uint64_t *undecided)
{
    lane_shape s;
    uint64_t left = LANES_ALL;
    for (int a = 0; a < 3; a++) {
        left = load_axis_of_soup(p, from, at, a, kind, left, &s);
        if (!left) {
            seen->apart[a] |= packet;
            *undecided = 0;
            return 0;
        }
    }
    shape_normal(&s);
    if (kind & WALKS_BY_SIGN)
        return survey_by_sign(&s, kind, packet, left, seen, undecided);
    return survey_by_margin(p, &s, kind, packet, left, seen, undecided);
}

TRIBOX_INLINE uint64_t survey_word(const tribox_query *from, size_t word, walk_kind kind, tribox_seen *seen, uint64_t *undecided)
{
    uint64_t word_hit = 0, word_open = 0;
    lane_pairs p;
    start_pairs(&p, from, kind);
    *seen = (tribox_seen){.packets = 64 / V_LANES};
    for (int lane = 0; lane < 64; lane += V_LANES) {
        uint64_t packet_open;
        word_hit |= survey_packet(&p, from, 64 * word + (size_t)lane, kind, UINT64_C(1) << lane / V_LANES, seen, &packet_open)
                    << lane;
        word_open |= packet_open << lane;
    }
    *undecided = word_open;
    return word_hit;
}
