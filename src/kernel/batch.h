/*
 * batch.h - the walks: a soup against one box, or one triangle against many boxes, in words of 64, each in packets of V_LANES.
 * After: packet.h and every other text of float.h: it ends with the table of what the kernel does. Needs: KERNEL.
 *
 * A walk is one text whose accuracy and sequence of groups (kernel.h) are constants: every instance below keeps only its own
 * tests. Where the box normals come first, x is loaded and tested, then y, then z, each only if a lane is left: far from the box a
 * soup costs the traffic of one axis. Between the other groups a packet ends as soon as no lane is left.
 */

/* Word w of a walk, or its first `lanes` lanes: returns the hits, and in *open what is left open. */
TRIBOX_INLINE uint64_t walk_word(lane_pairs *p, const lane_source *from, size_t word, int lanes, unsigned sequence,
                                 tribox_accuracy accuracy, bool looks_again, uint64_t *open)
{
    uint64_t word_hit = 0, word_open = 0; /* kept in registers, so that stores cannot alias the streams */
    for (int lane = 0; lane < lanes; lane += V_LANES) {
        uint64_t packet_open;
        word_hit |= packet(p, from, 64 * word + (size_t)lane, sequence, accuracy, looks_again, &packet_open) << lane;
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
TRIBOX_INLINE void walk_words(const lane_source *from, size_t word, size_t count, uint64_t *hit, uint64_t *open, unsigned sequence,
                              tribox_accuracy accuracy)
{
    const bool has_second_look = accuracy != TRIBOX_FAST && sequence_has(sequence, 1) && sequence != 1;
    const size_t words = (count + 63) / 64;
    const int last_lanes = (int)(count - 64 * (words - 1));
    size_t w = 0;
    lane_pairs p;
    start_pairs(&p, from);
    for (; w < words; w++) {
        hit[w] = walk_word(&p, from, word + w, w + 1 < words ? 64 : last_lanes, sequence, accuracy, false, &open[w]);
        if (has_second_look && has_several(open[w]))
            break;
    }
    for (; has_second_look && w < words; w++)
        hit[w] = walk_word(&p, from, word + w, w + 1 < words ? 64 : last_lanes, sequence, accuracy, true, &open[w]);
}

#define WALKS(name, accuracy, sequence) \
    static void name##_soup_##sequence(const tribox_soup *soup, const tribox_box *box, size_t word, size_t count, uint64_t *hit, \
                                       uint64_t *open) \
    { \
        walk_words(&(lane_source){.is_soup = true, .soup = soup, .box = box}, word, count, hit, open, sequence, accuracy); \
    } \
    static void name##_boxes_##sequence(const float triangle[3][3], const tribox_boxes *boxes, size_t word, size_t count, \
                                        uint64_t *hit, uint64_t *open) \
    { \
        walk_words(&(lane_source){.is_soup = false, .triangle = triangle, .boxes = boxes}, word, count, hit, open, sequence, \
                   accuracy); \
    }
#define EXACT_WALKS(sequence) WALKS(exact, TRIBOX_EXACT, sequence)
#define CONSERVATIVE_WALKS(sequence) WALKS(conservative, TRIBOX_CONSERVATIVE, sequence)
#define FAST_WALKS(sequence) WALKS(fast, TRIBOX_FAST, sequence)
TRIBOX_FOR_EACH_SEQUENCE(EXACT_WALKS)
TRIBOX_FOR_EACH_SEQUENCE(CONSERVATIVE_WALKS)
TRIBOX_FOR_EACH_SEQUENCE(FAST_WALKS)

#define EXACT_SOUP(sequence) [TRIBOX_SEQUENCE_##sequence] = exact_soup_##sequence,
#define CONSERVATIVE_SOUP(sequence) [TRIBOX_SEQUENCE_##sequence] = conservative_soup_##sequence,
#define FAST_SOUP(sequence) [TRIBOX_SEQUENCE_##sequence] = fast_soup_##sequence,
#define EXACT_BOXES(sequence) [TRIBOX_SEQUENCE_##sequence] = exact_boxes_##sequence,
#define CONSERVATIVE_BOXES(sequence) [TRIBOX_SEQUENCE_##sequence] = conservative_boxes_##sequence,
#define FAST_BOXES(sequence) [TRIBOX_SEQUENCE_##sequence] = fast_boxes_##sequence,
#define KERNEL_STRING_(name) #name
#define KERNEL_STRING(name) KERNEL_STRING_(name)

tribox_in_double TRIBOX_SYMBOL(double);
extern const tribox_grid_kernel TRIBOX_SYMBOL(grid);
extern const tribox_kernel TRIBOX_SYMBOL(kernel);
const tribox_kernel TRIBOX_SYMBOL(kernel) = {
    .name = KERNEL_STRING(KERNEL),
    .lanes = V_LANES,
    .soup = {[TRIBOX_EXACT] = {TRIBOX_FOR_EACH_SEQUENCE(EXACT_SOUP)},
             [TRIBOX_CONSERVATIVE] = {TRIBOX_FOR_EACH_SEQUENCE(CONSERVATIVE_SOUP)},
             [TRIBOX_FAST] = {TRIBOX_FOR_EACH_SEQUENCE(FAST_SOUP)}},
    .boxes = {[TRIBOX_EXACT] = {TRIBOX_FOR_EACH_SEQUENCE(EXACT_BOXES)},
              [TRIBOX_CONSERVATIVE] = {TRIBOX_FOR_EACH_SEQUENCE(CONSERVATIVE_BOXES)},
              [TRIBOX_FAST] = {TRIBOX_FOR_EACH_SEQUENCE(FAST_BOXES)}},
    .inside = inside,
    .greatest_vertex = greatest_vertex,
    .gather = gather,
    .is_beside = is_beside,
    .to_frame = to_frame,
    .in_double = TRIBOX_SYMBOL(double),
    .grid = &TRIBOX_SYMBOL(grid),
};
