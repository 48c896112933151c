/*
 * batch.h - the walks: a soup against one box, or one triangle against many boxes, in words of 64, each in packets of V_LANES.
 * After: packet.h and every other text of pairs_text.h: it ends with the table of what the kernel does. Needs: KERNEL,
 * inexact_flag.h.
 *
 * A walk is one text whose kind and sequence of groups (kernel.h) are constants: every instance below keeps only its own
 * tests. Where the box normals come first, x is loaded and tested, then y, then z, each only if a lane is left: far from the box a
 * soup costs the traffic of one axis. Between the other groups a packet ends as soon as no lane is left.
 */

/* Whether a word has three or more bits set. */
TRIBOX_INLINE bool has_several(uint64_t bits)
{
    bits &= bits - 1;
    return bits & (bits - 1);
}

/* Whether the rest of a walk takes the second look of ties.h, from the first run on that leaves several lanes undecided. */
TRIBOX_INLINE bool may_look_again(walk_kind kind)
{
    return !(kind & (WALKS_BY_SIGN | LOOKS_AGAIN)) && sequence_has(groups_of(kind), 1) && groups_of(kind) != 1;
}

/*
 * Whether a walk leaves out words that lie wholly in the box, after one that overlaps it altogether: in coherent soups they come in
 * rows. They overlap (PROOFS.md 1, consequence 4). FAST may find them apart, and its answers would hang on neighbours.
 */
TRIBOX_INLINE bool may_lie_inside(walk_kind kind) { return (kind & (WALKS_SOUP | WALKS_MESH | WALKS_BY_SIGN)) == WALKS_SOUP; }

/* Words of a walk that are not asked after one that was asked for nothing: that takes as long as to test a packet in part. */
enum { WORDS_UNASKED = 16 };

/* Marks words from 64 * word + done on that lie wholly in the box as hits, and returns where they end. */
TRIBOX_INLINE size_t pass_words_inside(const tribox_query *from, size_t word, size_t done, size_t count, uint64_t *hit,
                                       uint64_t *undecided)
{
    for (size_t left = words_inside(from->soup, from->box, 64 * word + done, 64 * word + count); left; left--, done += 64) {
        hit[done / 64] = ~UINT64_C(0);
        undecided[done / 64] = 0;
    }
    return done;
}

/*
 * Pairs 64 * word + done to before 64 * word + count, or to the run that a second look takes. Returns how many are done. Each form
 * of a packet has its own. Bits of a run are kept in registers, so that stores cannot alias the streams.
 */
#define WALK_WORDS(form) \
    TRIBOX_INLINE size_t walk_words_##form(const tribox_query *from, size_t word, size_t done, size_t count, uint64_t *hit, \
                                           uint64_t *undecided, walk_kind kind) \
    { \
        size_t unasked = done; \
        packet_run run; \
        lane_pairs p; \
        start_pairs(&p, from, kind); \
        for (; done < count; done += run.pairs) { \
            uint64_t run_hit = 0, run_open = 0; \
            run = run_of_packets(64 * word + done, 64 * word + count, 64); \
            for (size_t lane = 0; lane < run.lanes; lane += V_LANES) { \
                uint64_t packet_open; \
                run_hit |= packet_##form(&p, from, run.at + lane, kind, &packet_open) << lane; \
                run_open |= packet_open << lane; \
            } \
            if (may_look_again(kind) && has_several(run_open)) \
                break; \
            put_run(&hit[done / 64], done % 64, run_hit, &run); \
            put_run(&undecided[done / 64], done % 64, run_open, &run); \
            if (may_lie_inside(kind) && run_hit == ~UINT64_C(0) && done >= unasked) { \
                const size_t inside = pass_words_inside(from, word, done + 64, count, hit, undecided) - 64; \
                unasked = inside > done ? inside : done + 64 * (size_t)WORDS_UNASKED; \
                done = inside; \
            } \
        } \
        return done; \
    }
PACKET(mesh_joint_BY_MARGIN, load_axis_of_mesh, overlaps_by_joint_margin)
PACKET(mesh_joint_BY_SIGN, load_axis_of_mesh, overlaps_by_joint_signs)
PACKET(mesh_apart_BY_MARGIN, load_axis_of_mesh, overlaps_by_margin)
PACKET(boxes_joint_BY_MARGIN, load_axis_of_boxes, overlaps_by_joint_margin)
PACKET(boxes_joint_BY_SIGN, load_axis_of_boxes, overlaps_by_joint_signs)
PACKET(boxes_apart_BY_MARGIN, load_axis_of_boxes, overlaps_by_margin)
PACKET(boxes_apart_BY_SIGN, load_axis_of_boxes, overlaps_by_sign)
WALK_WORDS(soup_apart_BY_MARGIN)
WALK_WORDS(soup_apart_BY_SIGN)
WALK_WORDS(soup_joint_BY_MARGIN)
WALK_WORDS(soup_joint_BY_SIGN)
WALK_WORDS(soup_alone_BY_MARGIN)
WALK_WORDS(soup_alone_BY_SIGN)
WALK_WORDS(mesh_joint_BY_MARGIN)
WALK_WORDS(mesh_joint_BY_SIGN)
WALK_WORDS(mesh_apart_BY_MARGIN)
WALK_WORDS(boxes_joint_BY_MARGIN)
WALK_WORDS(boxes_joint_BY_SIGN)
WALK_WORDS(boxes_apart_BY_MARGIN)
WALK_WORDS(boxes_apart_BY_SIGN)

/* Whether the flag rises in this kernel's own arithmetic: as in settle/doubles.h, here in float. */
TRIBOX_INLINE bool is_rounding_seen(void)
{
    const volatile float odd = 1 + 0x1p-23f;
    tribox_exactness_watch();
    const vnum a = v_splat(odd);
    return !tribox_exactness_kept(m_bits(v_gt(v_fma(a, a, a), a)));
}

/* Of so many pairs at once the flag is asked: few at first, as most numbers are long, then each time more. */
enum { WATCHED_FIRST = 64, WATCHED_MORE = 4 };

/*
 * The same pairs by sign for as long as nothing of them is rounded, ties included (PROOFS.md 6.7). In one order, as none changes an
 * answer. Returns how many are done; what is written of others means nothing. So it begins with a whole word, or not at all: to the
 * rest of one, bits are added.
 */
TRIBOX_NOINLINE size_t walk_exactly(const tribox_query *from, size_t word, size_t done, size_t count, uint64_t *hit,
                                    uint64_t *undecided)
{
    if (done % 64 || !is_rounding_seen())
        return done;
    for (size_t watched = WATCHED_FIRST, end; done < count; done = end, watched *= WATCHED_MORE) {
        uint64_t result = 0;
        end = count - done > watched ? done + watched : count;
        tribox_exactness_watch();
        walk_words_soup_joint_BY_SIGN(from, word, done, end, hit, undecided, 132 | WALKS_SOUP | WALKS_BY_SIGN | ASKS_FLAG);
        for (size_t w = done / 64; w < (end + 63) / 64; w++)
            result |= hit[w] ^ undecided[w];
        if (!tribox_exactness_kept(result))
            break;
    }
    return done;
}

/*
 * What a walk by margin leaves of a soup, for all axes and in one order: a loop of its own, so that scenes without ties keep fewer
 * numbers. It changes no answer: a slower stage would decide the same (PROOFS.md 5.3). Where ties are common numbers are often
 * short, and nothing of them is rounded: then signs decide.
 */
TRIBOX_NOINLINE void look_again(const tribox_query *from, size_t word, size_t done, size_t count, uint64_t *hit,
                                uint64_t *undecided)
{
    if (from->ties != TRIBOX_TIES_LEFT)
        done = walk_exactly(from, word, done, count, hit, undecided);
    walk_words_soup_joint_BY_MARGIN(from, word, done, count, hit, undecided, 132 | WALKS_SOUP | LOOKS_AGAIN);
}

/* A survey of a soup: where it would leave pairs undecided, the flag may decide the whole word. */
TRIBOX_INLINE uint64_t survey_soup(const tribox_query *from, size_t word, walk_kind kind, tribox_seen *seen, uint64_t *undecided)
{
    uint64_t exact_hit = 0, exact_open = 0;
    const uint64_t hit = survey_word(from, word, kind, seen, undecided);
    if (kind & WALKS_BY_SIGN || from->ties == TRIBOX_TIES_LEFT || !*undecided)
        return hit;
    const bool is_exact = walk_exactly(from, word, 0, 64, &exact_hit, &exact_open);
    seen->has_ties = true;
    seen->are_ties_exact = is_exact;
    *undecided = is_exact ? exact_open : *undecided;
    return is_exact ? exact_hit : hit;
}

/*
 * All that are no soups. Orders are for soups: to read corners, or boxes, takes so long that they would gain little there. Meshes
 * are walked only where all axes are asked. Boxes of some axes, and what boxes leave, are rare: one instance asks as it runs what
 * others know as they are compiled.
 */
TRIBOX_NOINLINE void walk_others_BY_MARGIN(const tribox_query *from, size_t word, size_t count, uint64_t *hit, uint64_t *undecided,
                                           unsigned groups)
{
    size_t done = 0;
    if (from->corners) {
        const walk_kind kind = 132 | WALKS_SOUP | WALKS_MESH;
        done = walk_words_mesh_joint_BY_MARGIN(from, word, 0, count, hit, undecided, kind);
        walk_words_mesh_joint_BY_MARGIN(from, word, done, count, hit, undecided, kind | LOOKS_AGAIN);
        return;
    }
    if (groups > 99)
        done = walk_words_boxes_joint_BY_MARGIN(from, word, 0, count, hit, undecided, 132);
    for (walk_kind kind = groups > 99 ? 132 | LOOKS_AGAIN : groups; done < count; kind |= LOOKS_AGAIN)
        done = walk_words_boxes_apart_BY_MARGIN(from, word, done, count, hit, undecided, kind);
}

TRIBOX_NOINLINE void walk_others_BY_SIGN(const tribox_query *from, size_t word, size_t count, uint64_t *hit, uint64_t *undecided,
                                         unsigned groups)
{
    if (from->corners)
        walk_words_mesh_joint_BY_SIGN(from, word, 0, count, hit, undecided, 132 | WALKS_SOUP | WALKS_MESH | WALKS_BY_SIGN);
    else if (groups > 99)
        walk_words_boxes_joint_BY_SIGN(from, word, 0, count, hit, undecided, 132 | WALKS_BY_SIGN);
    else
        walk_words_boxes_apart_BY_SIGN(from, word, 0, count, hit, undecided, groups | WALKS_BY_SIGN);
}

/* A walk of each kind and sequence, a loop of its own for soups: asked once a walk, and not once a packet. */
#define WALK_BY_MARGIN(groups, how) \
    static void walk_BY_MARGIN_##groups(const tribox_query *pairs, size_t word, size_t count, uint64_t *hit, uint64_t *undecided) \
    { \
        size_t done = 0; \
        if (!TRIBOX_WALKS_SOUPS_ALONE && !pairs->soup) { \
            walk_others_BY_MARGIN(pairs, word, count, hit, undecided, groups); \
            return; \
        } \
        if (groups < 100 || pairs->ties != TRIBOX_TIES_AT_ONCE) \
            done = walk_words_soup_##how##_BY_MARGIN(pairs, word, 0, count, hit, undecided, groups | WALKS_SOUP); \
        if (groups > 99 && done < count) \
            look_again(pairs, word, done, count, hit, undecided); \
        if (groups == 12 || groups == 13) \
            walk_words_soup_apart_BY_MARGIN(pairs, word, done, count, hit, undecided, groups | WALKS_SOUP | LOOKS_AGAIN); \
    }
#define WALK_BY_SIGN(groups, how) \
    static void walk_BY_SIGN_##groups(const tribox_query *pairs, size_t word, size_t count, uint64_t *hit, uint64_t *undecided) \
    { \
        if (TRIBOX_WALKS_SOUPS_ALONE || pairs->soup) \
            walk_words_soup_##how##_BY_SIGN(pairs, word, 0, count, hit, undecided, groups | WALKS_SOUP | WALKS_BY_SIGN); \
        else \
            walk_others_BY_SIGN(pairs, word, count, hit, undecided, groups); \
    }
TRIBOX_FOR_EACH_SEQUENCE(WALK_BY_MARGIN)
TRIBOX_FOR_EACH_SEQUENCE(WALK_BY_SIGN)

/*
 * Surveys with the second look of ties.h where margins decide: it changes no answer, and a survey cannot know whether it is needed.
 * The flag is asked about what is left.
 */
static uint64_t survey_BY_MARGIN(const tribox_query *pairs, size_t word, tribox_seen *seen, uint64_t *undecided)
{
    return survey_soup(pairs, word, 123 | WALKS_SOUP | LOOKS_AGAIN, seen, undecided);
}

static uint64_t survey_BY_SIGN(const tribox_query *pairs, size_t word, tribox_seen *seen, uint64_t *undecided)
{
    return survey_soup(pairs, word, 123 | WALKS_SOUP | WALKS_BY_SIGN, seen, undecided);
}

/*
 * Pairs of a word at most, and nothing past them is read: what a short call asks, with as little around its packets as can be. In
 * one order: another would gain nothing on few.
 */
#define WALK_FEW(level, name, form, of) \
    level uint64_t name(const tribox_query *from, size_t count, uint64_t *undecided) \
    { \
        const walk_kind kind = 132 | WALKS_FEW | (of); \
        uint64_t hit = 0, open = 0; \
        lane_pairs p; \
        if (kind & LOOKS_AGAIN) /* the one of all, which compilers take to be unset */ \
            splat_triangle(&p.t, (const float[9]){0}); \
        start_pairs(&p, from, kind); \
        for (size_t at = 0; at < count; at += V_LANES) { \
            uint64_t packet_open; \
            p.few = count - at < V_LANES ? count - at : V_LANES; \
            hit |= packet_##form(&p, from, at, kind, &packet_open) << at; \
            open |= packet_open << at; \
        } \
        *undecided = open; \
        return hit; \
    }
WALK_FEW(TRIBOX_INLINE, few_of_soup_BY_MARGIN, soup_joint_BY_MARGIN, WALKS_SOUP)
WALK_FEW(TRIBOX_INLINE, few_of_soup_BY_SIGN, soup_joint_BY_SIGN, WALKS_SOUP | WALKS_BY_SIGN)
WALK_FEW(TRIBOX_INLINE, few_of_mesh_BY_MARGIN, mesh_joint_BY_MARGIN, WALKS_SOUP | WALKS_MESH)
WALK_FEW(TRIBOX_INLINE, few_of_mesh_BY_SIGN, mesh_joint_BY_SIGN, WALKS_SOUP | WALKS_MESH | WALKS_BY_SIGN)
WALK_FEW(TRIBOX_INLINE, few_of_boxes_BY_MARGIN, boxes_joint_BY_MARGIN, 0)
WALK_FEW(TRIBOX_INLINE, few_of_boxes_BY_SIGN, boxes_joint_BY_SIGN, WALKS_BY_SIGN)

/* The second look is rare: one instance asks as it runs of what the pairs are. */
PACKET(few_again, load_axis, overlaps_by_joint_margin)
WALK_FEW(TRIBOX_NOINLINE, look_again_at_few, few_again,
         LOOKS_AGAIN | (from->soup      ? WALKS_SOUP
                        : from->corners ? WALKS_SOUP | WALKS_MESH
                                        : 0))

static uint64_t walk_few_BY_MARGIN(const tribox_query *from, size_t count, uint64_t *undecided)
{
    const uint64_t hit = TRIBOX_WALKS_SOUPS_ALONE || from->soup ? few_of_soup_BY_MARGIN(from, count, undecided)
                         : from->corners                        ? few_of_mesh_BY_MARGIN(from, count, undecided)
                                                                : few_of_boxes_BY_MARGIN(from, count, undecided);
    return has_several(*undecided) ? look_again_at_few(from, count, undecided) : hit;
}

static uint64_t walk_few_BY_SIGN(const tribox_query *from, size_t count, uint64_t *undecided)
{
    return TRIBOX_WALKS_SOUPS_ALONE || from->soup ? few_of_soup_BY_SIGN(from, count, undecided)
           : from->corners                        ? few_of_mesh_BY_SIGN(from, count, undecided)
                                                  : few_of_boxes_BY_SIGN(from, count, undecided);
}

static void walk_local_box(const tribox_query *pairs, size_t word, size_t count, uint64_t *hit, uint64_t *undecided)
{
    walk_words_mesh_apart_BY_MARGIN(pairs, word, 0, count, hit, undecided, 1 | WALKS_SOUP | WALKS_MESH | WALKS_LOCAL);
}

/* In one order: reading doubles takes as long as what another could save. */
static void walk_local_all(const tribox_query *pairs, size_t word, size_t count, uint64_t *hit, uint64_t *undecided)
{
    const walk_kind kind = 132 | WALKS_SOUP | WALKS_MESH | WALKS_LOCAL;
    const size_t done = walk_words_mesh_joint_BY_MARGIN(pairs, word, 0, count, hit, undecided, kind);
    walk_words_mesh_joint_BY_MARGIN(pairs, word, done, count, hit, undecided, kind | LOOKS_AGAIN);
}

#define ENTRY(decides, sequence) [TRIBOX_##decides][TRIBOX_SEQUENCE_##sequence] = walk_##decides##_##sequence,
#define ENTRIES(sequence, how) ENTRY(BY_MARGIN, sequence) ENTRY(BY_SIGN, sequence)
#define KERNEL_STRING_(name) #name
#define KERNEL_STRING(name) KERNEL_STRING_(name)

extern const tribox_settle_kernel TRIBOX_SYMBOL(settle);
extern const tribox_cells_kernel TRIBOX_SYMBOL(cells);
extern const tribox_rows_kernel TRIBOX_SYMBOL(rows);
extern const tribox_nodes_kernel TRIBOX_SYMBOL(nodes);
extern const tribox_kernel TRIBOX_SYMBOL(kernel);
const tribox_kernel TRIBOX_SYMBOL(kernel) = {
    .name = KERNEL_STRING(KERNEL),
    .lanes = V_LANES,
    .rounds_products = rounds_products,
    .walk = {TRIBOX_FOR_EACH_SEQUENCE(ENTRIES)},
    .walk_few = {[TRIBOX_BY_MARGIN] = TRIBOX_WALKS_SOUPS_ALONE ? NULL : walk_few_BY_MARGIN,
                 [TRIBOX_BY_SIGN] = TRIBOX_WALKS_SOUPS_ALONE ? NULL : walk_few_BY_SIGN},
    .survey = {[TRIBOX_BY_MARGIN] = survey_BY_MARGIN, [TRIBOX_BY_SIGN] = survey_BY_SIGN},
    .walk_local = {[TRIBOX_LOCAL_BOX] = walk_local_box, [TRIBOX_LOCAL_ALL] = walk_local_all},
    .spread_triangles = spread_triangles,
    .spread_boxes = spread_boxes,
    .inside = inside,
    .find_vertices = find_vertices,
    .find_corners = find_corners,
    .gather = gather,
    .is_apart = is_mesh_apart,
    .code = code_positions,
    .to_frame = to_frame,
    .split = {[TRIBOX_SPLIT_BY_MARGIN] = split_by_margin,
              [TRIBOX_SPLIT_BY_SIGN] = TRIBOX_WALKS_SOUPS_ALONE ? split_by_margin : split_by_sign,
              [TRIBOX_SPLIT_LOCAL] = split_local,
              [TRIBOX_SPLIT_BOX] = split_box,
              [TRIBOX_SPLIT_LOCAL_BOX] = split_local_box},
    .pack = pack,
    .settle = &TRIBOX_SYMBOL(settle),
    .cells = &TRIBOX_SYMBOL(cells),
    .rows = &TRIBOX_SYMBOL(rows),
    .nodes = &TRIBOX_SYMBOL(nodes),
};
