/*
 * batch.h - the walks: a soup against one box, or one triangle against many boxes, in words of 64, each in packets of V_LANES.
 * After: packet.h and every other text of float.h: it ends with the table of what the kernel does. Needs: KERNEL.
 *
 * A walk is one text whose accuracy and sequence of groups (kernel.h) are constants: every instance below keeps only its own
 * tests. Where the box normals come first, x is loaded and tested, then y, then z, each only if a lane is left: far from the box a
 * soup costs the traffic of one axis. Between the other groups a packet ends as soon as no lane is left.
 */

/* Word w of a walk, or its first `lanes` lanes: returns the hits, and in *open what is left open. */
TRIBOX_INLINE uint64_t walk_word(lane_pairs *p, const tribox_pairs *from, size_t word, int lanes, walk_kind kind, uint64_t *open)
{
    uint64_t word_hit = 0, word_open = 0; /* kept in registers, so that stores cannot alias the streams */
    for (int lane = 0; lane < lanes; lane += V_LANES) {
        uint64_t packet_open;
        word_hit |= packet(p, from, 64 * word + (size_t)lane, kind, &packet_open) << lane;
        word_open |= packet_open << lane;
    }
    *open = word_open;
    return word_hit;
}

/* Whether a word has three or more bits set. */
TRIBOX_INLINE bool has_several(uint64_t bits)
{
    bits &= bits - 1;
    return bits & (bits - 1);
}

/*
 * Two loops, so that scenes without ties keep fewer numbers: from the first word that leaves several lanes open, the rest of the
 * walk takes the second look of ties.h. It changes no answer: a slower stage would decide the same (PROOFS.md 5.3).
 */
TRIBOX_INLINE void walk_words(const tribox_pairs *from, size_t word, size_t count, uint64_t *hit, uint64_t *open, walk_kind kind)
{
    const bool has_second_look = kind.accuracy != TRIBOX_FAST && sequence_has(kind.sequence, 1) && kind.sequence != 1;
    const walk_kind looks_again = {kind.sequence, kind.accuracy, kind.is_soup, true};
    const size_t words = (count + 63) / 64;
    const int last_lanes = (int)(count - 64 * (words - 1));
    size_t w = 0;
    lane_pairs p;
    start_pairs(&p, from, kind);
    for (; w < words; w++) {
        hit[w] = walk_word(&p, from, word + w, w + 1 < words ? 64 : last_lanes, kind, &open[w]);
        if (has_second_look && has_several(open[w]))
            break;
    }
    for (; has_second_look && w < words; w++)
        hit[w] = walk_word(&p, from, word + w, w + 1 < words ? 64 : last_lanes, looks_again, &open[w]);
}

/* Both forms of one accuracy and sequence, each a loop of its own: asked once a walk, and not once a packet. */
#define WALK(accuracy, sequence) \
    static void walk_##accuracy##_##sequence(const tribox_pairs *pairs, size_t word, size_t count, uint64_t *hit, uint64_t *open) \
    { \
        if (pairs->soup) \
            walk_words(pairs, word, count, hit, open, (walk_kind){sequence, TRIBOX_##accuracy, true, false}); \
        else \
            walk_words(pairs, word, count, hit, open, (walk_kind){sequence, TRIBOX_##accuracy, false, false}); \
    }
#define WALKS(sequence) WALK(EXACT, sequence) WALK(CONSERVATIVE, sequence) WALK(FAST, sequence)
TRIBOX_FOR_EACH_SEQUENCE(WALKS)

#define ENTRY(accuracy, sequence) [TRIBOX_##accuracy][TRIBOX_SEQUENCE_##sequence] = walk_##accuracy##_##sequence,
#define ENTRIES(sequence) ENTRY(EXACT, sequence) ENTRY(CONSERVATIVE, sequence) ENTRY(FAST, sequence)
#define KERNEL_STRING_(name) #name
#define KERNEL_STRING(name) KERNEL_STRING_(name)

tribox_in_double TRIBOX_SYMBOL(double);
extern const tribox_grid_kernel TRIBOX_SYMBOL(grid);
extern const tribox_kernel TRIBOX_SYMBOL(kernel);
const tribox_kernel TRIBOX_SYMBOL(kernel) = {
    .name = KERNEL_STRING(KERNEL),
    .lanes = V_LANES,
    .walk = {TRIBOX_FOR_EACH_SEQUENCE(ENTRIES)},
    .inside = inside,
    .greatest_vertex = greatest_vertex,
    .gather = gather,
    .is_beside = is_beside,
    .to_frame = to_frame,
    .in_double = TRIBOX_SYMBOL(double),
    .grid = &TRIBOX_SYMBOL(grid),
};
