/*
 * The walks: a soup against one box, or one triangle against many boxes, in words of 64.
 *
 * A walk is one text whose sequence of groups (kernel.h) is a constant: every instance below keeps only its own tests. Where the
 * box normals come first they are asked of a whole word, one axis at a time, and the streams of the next axis are loaded only if a
 * lane is left. The other groups are asked of packets of V_LANES, and of those only where a lane is left.
 */

#define LANES_ALL (~UINT64_C(0) >> (64 - V_LANES))

/* The k-th group of a sequence, 0 past its end. */
TRIBOX_INLINE unsigned group_at(unsigned sequence, int k)
{
    const int length = sequence > 99 ? 3 : sequence > 9 ? 2 : 1;
    for (int drop = length - 1 - k; drop > 0; drop--)
        sequence /= 10;
    return k < length ? sequence % 10 : 0;
}

TRIBOX_INLINE bool sequence_has(unsigned sequence, unsigned group)
{
    return group_at(sequence, 0) == group || group_at(sequence, 1) == group || group_at(sequence, 2) == group;
}

TRIBOX_INLINE void load_triangle(lane_triangle *t, const tribox_soup *soup, size_t at)
{
    for (int j = 0; j < 3; j++) {
        t->u[j][0] = v_load(soup->x[j] + at);
        t->u[j][1] = v_load(soup->y[j] + at);
        t->u[j][2] = v_load(soup->z[j] + at);
    }
}

TRIBOX_INLINE void splat_triangle(lane_triangle *t, const float triangle[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t->u[j][a] = v_splat(triangle[j][a]);
}

TRIBOX_INLINE void load_box(lane_box *box, const tribox_boxes *boxes, size_t at)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = v_load(boxes->lo[a] + at);
        box->hi[a] = v_load(boxes->hi[a] + at);
    }
}

TRIBOX_INLINE void splat_box(lane_box *box, const tribox_box *from)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = v_splat(from->lo[a]);
        box->hi[a] = v_splat(from->hi[a]);
    }
}

/* Bullet 1 on axis a for a word of triangles: the lanes that are not apart. */
TRIBOX_INLINE uint64_t word_on_box_normal(const float *const stream[3], size_t at, vnum lo, vnum hi)
{
    uint64_t apart = 0;
    for (int lane = 0; lane < 64; lane += V_LANES) {
        const size_t i = at + (size_t)lane;
        apart |= m_bits(apart_on_box_normal(v_load(stream[0] + i), v_load(stream[1] + i), v_load(stream[2] + i), lo, hi)) << lane;
    }
    return ~apart;
}

/* The same for a word of boxes. An empty box, and one with a bound that is NaN or infinite, is apart from everything. */
TRIBOX_INLINE uint64_t word_of_boxes_on_axis(const float *lo, const float *hi, size_t at, vnum least, vnum most, bool is_axis_asked)
{
    uint64_t left = 0;
    for (int lane = 0; lane < 64; lane += V_LANES) {
        const vnum l = v_load(lo + at + lane), h = v_load(hi + at + lane);
        const vmask finite = m_and(v_gt(v_splat(INFINITY), v_abs(l)), v_gt(v_splat(INFINITY), v_abs(h)));
        vmask apart = v_gt(l, h);
        if (is_axis_asked)
            apart = m_or(apart, m_or(v_gt(least, h), v_gt(l, most)));
        left |= m_bits(m_andnot(finite, apart)) << lane;
    }
    return left;
}

/* The lanes that one group separates. */
TRIBOX_INLINE vmask apart_on_group(unsigned group, const lane_triangle *t, const lane_box *box, const lane_shape *s, vnum reach,
                                   bool is_box_asked)
{
    const vnum zero = v_splat(0);
    vmask apart = v_gt(zero, zero);
    if (group == 1)
        for (int a = 0; a < 3; a++)
            apart = m_or(apart, apart_on_box_normal(t->u[0][a], t->u[1][a], t->u[2][a], box->lo[a], box->hi[a]));
    if (group == 2)
        apart = v_gt(zero, plane_slack(s, reach));
    if (group == 3)
        apart =
            is_box_asked
                ? v_gt(zero, lane_min3(edges_slack(s, 0), edges_slack(s, 1), edges_slack(s, 2)))
                : v_gt(zero, lane_min3(edges_slack_both_sides(s, 0), edges_slack_both_sides(s, 1), edges_slack_both_sides(s, 2)));
    return apart;
}

/*
 * FAST for one packet, of whose lanes `left` have survived so far: *hit and *open as of kernel.h, moved to the packet's place.
 * A lane whose reach along n is not finite may hold a NaN or an infinity, which min and max lose; such lanes are left open. Where
 * the plane is not asked, the sum of the nine coordinates tells.
 */
TRIBOX_INLINE void packet_fast(const lane_triangle *t, const lane_box *box, unsigned sequence, int done, uint64_t left, int lane,
                               uint64_t *hit, uint64_t *open)
{
    const lane_shape s = shape_of(t, box);
    const vnum reach = plane_reach(&s);
    for (int k = done; k < 3 && group_at(sequence, k); k++) {
        left &= ~m_bits(apart_on_group(group_at(sequence, k), t, box, &s, reach, sequence_has(sequence, 1)));
        if (!left)
            return;
    }
    vnum witness = reach;
    if (!sequence_has(sequence, 2)) {
        witness = v_add(v_add(t->u[0][0], t->u[0][1]), t->u[0][2]);
        for (int j = 1; j < 3; j++)
            witness = v_add(witness, v_add(v_add(t->u[j][0], t->u[j][1]), t->u[j][2]));
        witness = v_abs(witness);
    }
    const uint64_t finite = m_bits(v_gt(v_splat(INFINITY), witness));
    *hit |= (left & finite) << lane;
    *open |= (left & ~finite) << lane;
}

TRIBOX_INLINE void walk_soup(const tribox_soup *soup, const tribox_box *one, size_t word, size_t words, uint64_t *hit,
                             uint64_t *open, unsigned sequence)
{
    lane_box box;
    splat_box(&box, one);
    const float *const *const stream[3] = {soup->x, soup->y, soup->z};
    const int done = group_at(sequence, 0) == 1;
    for (size_t w = 0; w < words; w++) {
        const size_t at = 64 * (word + w);
        uint64_t left = ~UINT64_C(0), word_hit = 0, word_open = 0;
        for (int a = 0; done && left && a < 3; a++)
            left &= word_on_box_normal(stream[a], at, box.lo[a], box.hi[a]);
        for (int lane = 0; left && lane < 64; lane += V_LANES) {
            if (!(left >> lane & LANES_ALL))
                continue;
            lane_triangle t;
            load_triangle(&t, soup, at + (size_t)lane);
            packet_fast(&t, &box, sequence, done, left >> lane & LANES_ALL, lane, &word_hit, &word_open);
        }
        hit[w] = word_hit;
        open[w] = word_open;
    }
}

TRIBOX_INLINE void walk_boxes(const float triangle[3][3], const tribox_boxes *boxes, size_t word, size_t words, uint64_t *hit,
                              uint64_t *open, unsigned sequence)
{
    lane_triangle t;
    splat_triangle(&t, triangle);
    const bool is_box_asked = sequence_has(sequence, 1);
    const int done = group_at(sequence, 0) == 1;
    for (size_t w = 0; w < words; w++) {
        const size_t at = 64 * (word + w);
        uint64_t left = ~UINT64_C(0), word_hit = 0, word_open = 0;
        for (int a = 0; left && a < 3; a++)
            left &= word_of_boxes_on_axis(boxes->lo[a], boxes->hi[a], at, lane_min3(t.u[0][a], t.u[1][a], t.u[2][a]),
                                          lane_max3(t.u[0][a], t.u[1][a], t.u[2][a]), is_box_asked);
        for (int lane = 0; left && lane < 64; lane += V_LANES) {
            if (!(left >> lane & LANES_ALL))
                continue;
            lane_box box;
            load_box(&box, boxes, at + (size_t)lane);
            packet_fast(&t, &box, sequence, done, left >> lane & LANES_ALL, lane, &word_hit, &word_open);
        }
        hit[w] = word_hit;
        open[w] = word_open;
    }
}

#define WALKS(sequence) \
    static void soup_##sequence(const tribox_soup *soup, const tribox_box *box, size_t word, size_t words, uint64_t *hit, \
                                uint64_t *open) \
    { \
        walk_soup(soup, box, word, words, hit, open, sequence); \
    } \
    static void boxes_##sequence(const float triangle[3][3], const tribox_boxes *boxes, size_t word, size_t words, uint64_t *hit, \
                                 uint64_t *open) \
    { \
        walk_boxes(triangle, boxes, word, words, hit, open, sequence); \
    }
TRIBOX_FOR_EACH_SEQUENCE(WALKS)

#define SOUP_WALK(sequence) [TRIBOX_SEQUENCE_##sequence] = soup_##sequence,
#define BOXES_WALK(sequence) [TRIBOX_SEQUENCE_##sequence] = boxes_##sequence,
#define KERNEL_SYMBOL_(name) tribox_kernel_##name
#define KERNEL_SYMBOL(name) KERNEL_SYMBOL_(name)
#define KERNEL_STRING_(name) #name
#define KERNEL_STRING(name) KERNEL_STRING_(name)

extern const tribox_kernel KERNEL_SYMBOL(KERNEL);
const tribox_kernel KERNEL_SYMBOL(KERNEL) = {
    .name = KERNEL_STRING(KERNEL),
    .lanes = V_LANES,
    .soup_fast = {TRIBOX_FOR_EACH_SEQUENCE(SOUP_WALK)},
    .boxes_fast = {TRIBOX_FOR_EACH_SEQUENCE(BOXES_WALK)},
};
