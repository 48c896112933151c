/*
 * survey.h - a word walked as by 132 that also says which groups of axes reject whole packets: choice.c finds the order from it.
 * After: packet.h.
 *
 * A packet that the box normals reject is left as early as in a walk, and nothing else is asked about it.
 */

/* The lanes of a packet that the plane separates for this kind of walk, and those that the edges do, with no regard to other groups. */
typedef struct lanes_apart {
    uint64_t plane, edges;
} lanes_apart;

TRIBOX_INLINE lanes_apart lanes_apart_of(const lane_pairs *p, lane_shape *s, walk_kind kind)
{
    const joint_slacks slack = joint_slacks_of(s, kind);
    if (kind.decides == TRIBOX_BY_SIGN) {
        const vmask finite = v_gt(v_splat(INFINITY), slack.reach);
        return (lanes_apart){m_bits(m_and(finite, m_signs(slack.plane))), m_bits(m_and(finite, m_signs(slack.edges)))};
    }
    const lane_margin margin = margin_of(s, &p->margin, true);
    const vmask plane = v_gt(v_splat(0), v_add(slack.plane, margin.plane)),
                edges = v_gt(v_splat(0), v_add(slack.edges, margin.edges));
    return (lanes_apart){m_bits(m_and(margin.is_valid, plane)), m_bits(m_and(margin.is_valid, edges))};
}

/* Notes for each set of groups whether it rejects all lanes of a packet, whose lanes `left` are not apart on the box normals. */
TRIBOX_INLINE void note_packet(tribox_seen *seen, uint64_t packet, uint64_t left, lanes_apart apart)
{
    for (unsigned groups = 1; groups < TRIBOX_AXES_ALL; groups++) {
        const uint64_t rejected = (groups & TRIBOX_AXES_BOX ? LANES_ALL & ~left : 0) |
                                  (groups & TRIBOX_AXES_PLANE ? apart.plane : 0) | (groups & TRIBOX_AXES_EDGES ? apart.edges : 0);
        seen->rejected[groups] |= rejected == LANES_ALL ? packet : 0;
    }
}

/* A packet that the box normals up to this axis reject. */
TRIBOX_INLINE uint64_t note_beside(tribox_seen *seen, uint64_t packet, int axis)
{
    for (int a = axis; a < 3; a++)
        seen->beside[a] |= packet;
    for (unsigned groups = TRIBOX_AXES_BOX; groups < TRIBOX_AXES_ALL; groups += 2)
        seen->rejected[groups] |= packet;
    return 0;
}

TRIBOX_INLINE uint64_t survey_packet(lane_pairs *p, const tribox_pairs *from, size_t at, walk_kind kind, uint64_t packet,
                                     tribox_seen *seen, uint64_t *open)
{
    lane_shape s;
    uint64_t left = LANES_ALL;
    *open = 0;
    for (int a = 0; a < 3; a++) {
        left = load_axis(p, from, at, a, kind, left, &s);
        if (!left)
            return note_beside(seen, packet, a);
    }
    if (!kind.is_soup)
        p->margin = box_margin_of(&p->box);
    note_packet(seen, packet, left, lanes_apart_of(p, &s, kind));
    return kind.decides == TRIBOX_BY_SIGN ? overlaps_by_sign(p, &s, kind, left, open)
                                          : overlaps_by_joint_margin(p, &s, kind, left, open);
}

TRIBOX_INLINE uint64_t survey_word(const tribox_pairs *from, size_t word, walk_kind kind, tribox_seen *seen, uint64_t *open)
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
    *open = word_open;
    return word_hit;
}

/* With the second look of ties.h where margins decide: it changes no answer, and a survey cannot know whether it is needed. */
#define SURVEY(decides) \
    static uint64_t survey_##decides(const tribox_pairs *pairs, size_t word, tribox_seen *seen, uint64_t *open) \
    { \
        const bool looks_again = TRIBOX_##decides == TRIBOX_BY_MARGIN; \
        return pairs->soup ? survey_word(pairs, word, (walk_kind){132, TRIBOX_##decides, true, looks_again}, seen, open) \
                           : survey_word(pairs, word, (walk_kind){132, TRIBOX_##decides, false, looks_again}, seen, open); \
    }
SURVEY(BY_MARGIN)
SURVEY(BY_SIGN)
