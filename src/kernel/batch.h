/*
 * The walks: a soup against one box, or one triangle against many boxes, in words of 64, each in packets of V_LANES.
 *
 * A walk is one text whose sequence of groups (kernel.h) is a constant: every instance below keeps only its own tests. Where the
 * box normals come first, x is loaded and asked, then y, then z, each only if a lane is left: far from the box a soup costs the
 * traffic of one axis. Between the other groups a packet is left as soon as it has no lane.
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

TRIBOX_INLINE void splat_triangle(lane_triangle *t, const float triangle[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t->u[j][a] = v_splat(triangle[j][a]);
}

/*
 * The bounds on one axis. A zero lower bound is -0 and a zero upper bound +0 here, so that u - lo and hi - u are +0, and not
 * negative, for every zero u.
 */
TRIBOX_INLINE void set_bounds(lane_box *box, int a, vnum lo, vnum hi)
{
    const vnum zero = v_splat(0.0f), minus_zero = v_splat(-0.0f);
    box->lo[a] = v_flip(v_sub(zero, lo), minus_zero);
    box->hi[a] = v_add(hi, zero);
    box->H[a] = v_sub(hi, lo);
}

TRIBOX_INLINE void splat_box(lane_box *box, const tribox_box *from)
{
    for (int a = 0; a < 3; a++)
        set_bounds(box, a, v_splat(from->lo[a]), v_splat(from->hi[a]));
}

/* The lanes whose box has a point on this axis: finite bounds, lo <= hi. */
TRIBOX_INLINE vmask has_points(vnum lo, vnum hi)
{
    const vnum infinite = v_splat(INFINITY);
    return m_andnot(m_and(v_gt(infinite, v_abs(lo)), v_gt(infinite, v_abs(hi))), v_gt(lo, hi));
}

TRIBOX_INLINE void load_axis(lane_triangle *t, const tribox_soup *soup, size_t at, int a)
{
    const float *const *const stream = a == 0 ? soup->x : a == 1 ? soup->y : soup->z;
    for (int j = 0; j < 3; j++)
        t->u[j][a] = v_load(stream[j] + at);
}

/* The lanes that one group separates. */
TRIBOX_INLINE vmask apart_on_group(unsigned group, const lane_shape *s, vnum reach, bool is_box_asked)
{
    const vnum zero = v_splat(0);
    if (group == 1)
        return m_signs(v_either(v_either(apart_on_box_normal(s, 0), apart_on_box_normal(s, 1)), apart_on_box_normal(s, 2)));
    if (group == 2)
        return v_gt(zero, plane_slack(s, reach));
    if (is_box_asked)
        return v_gt(zero, lane_min3(edges_slack(s, 0), edges_slack(s, 1), edges_slack(s, 2)));
    return v_gt(zero, lane_min3(edges_slack_both_sides(s, 0), edges_slack_both_sides(s, 1), edges_slack_both_sides(s, 2)));
}

/* The pairs of a walk: a soup and one box, or, soup being NULL, one triangle and boxes. What there is one of stays in t or box. */
typedef struct lane_pairs {
    const tribox_soup *soup;
    const tribox_boxes *boxes;
    lane_triangle t;
    lane_box box;
} lane_pairs;

/*
 * FAST for the packet at pair `at`: the lanes that overlap, and in *open those that may hold a NaN or an infinity, which min and
 * max lose. The reach of the box along n is finite only where all coordinates are; where the plane is not asked, their sum tells.
 */
TRIBOX_INLINE uint64_t packet_fast(lane_pairs *p, size_t at, unsigned sequence, uint64_t *open)
{
    lane_shape s;
    uint64_t left = LANES_ALL;
    const bool is_box_first = group_at(sequence, 0) == 1;
    for (int a = 0; a < 3; a++) {
        if (p->soup) {
            load_axis(&p->t, p->soup, at, a);
        } else {
            const vnum lo = v_load(p->boxes->lo[a] + at), hi = v_load(p->boxes->hi[a] + at);
            left &= m_bits(has_points(lo, hi));
            set_bounds(&p->box, a, lo, hi);
        }
        shape_axis(&s, &p->t, &p->box, a);
        if (is_box_first)
            left &= ~m_bits(m_signs(apart_on_box_normal(&s, a)));
        if (!left)
            return *open = 0;
    }
    shape_normal(&s);
    vnum reach = plane_reach(&s);
    for (int k = is_box_first; k < 3 && group_at(sequence, k); k++) {
        left &= ~m_bits(apart_on_group(group_at(sequence, k), &s, reach, sequence_has(sequence, 1)));
        if (!left)
            return *open = 0;
    }
    if (!sequence_has(sequence, 2)) {
        reach = v_splat(0);
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                reach = v_add(reach, p->t.u[j][a]);
        reach = v_abs(reach);
    }
    const uint64_t finite = m_bits(v_gt(v_splat(INFINITY), reach));
    *open = left & ~finite;
    return left & finite;
}

TRIBOX_INLINE void walk(lane_pairs *p, size_t word, size_t words, uint64_t *hit, uint64_t *open, unsigned sequence)
{
    for (size_t w = 0; w < words; w++) {
        hit[w] = open[w] = 0;
        for (int lane = 0; lane < 64; lane += V_LANES) {
            uint64_t packet_open;
            hit[w] |= packet_fast(p, 64 * (word + w) + (size_t)lane, sequence, &packet_open) << lane;
            open[w] |= packet_open << lane;
        }
    }
}

TRIBOX_INLINE void walk_soup(const tribox_soup *soup, const tribox_box *box, size_t word, size_t words, uint64_t *hit,
                             uint64_t *open, unsigned sequence)
{
    lane_pairs p = {.soup = soup};
    splat_box(&p.box, box);
    walk(&p, word, words, hit, open, sequence);
}

TRIBOX_INLINE void walk_boxes(const float triangle[3][3], const tribox_boxes *boxes, size_t word, size_t words, uint64_t *hit,
                              uint64_t *open, unsigned sequence)
{
    lane_pairs p = {.boxes = boxes};
    splat_triangle(&p.t, triangle);
    walk(&p, word, words, hit, open, sequence);
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
