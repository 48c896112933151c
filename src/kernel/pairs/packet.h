/*
 * packet.h - one packet of V_LANES pairs, decided by sign or by margin, and in one sequence of groups: constants.
 * After: axes.h, corners.h, margin.h, ties.h, local.h. Needs: v_load_up_to.
 *
 * FAST trusts the sign of a computed slack (PROOFS.md 10). CONSERVATIVE and EXACT compare it with its error bound, and leave a
 * lane that has a slack within it to the next stage (doubles.h). What a hit then needs: `certain_overlaps`.
 */

TRIBOX_INLINE void splat_triangle(lane_triangle *t, const float triangle[9])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t->u[j][a] = v_splat(triangle[3 * j + a]);
}

TRIBOX_INLINE void splat_box(lane_box *box, const tribox_rounded_box *from)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = box->origin[a] = v_splat(from->of.origin[a]); /* it is lo where that is compared */
        box->hi[a] = v_splat(from->hi[a]);
        box->H[a] = v_splat(from->of.H[a]);
        box->C[a] = v_splat(from->of.C[a]);
    }
}

TRIBOX_INLINE void splat_fast_box(lane_box *box, const tribox_rounded_box *from)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = v_splat(from->lo[a]);
        box->hi[a] = v_splat(from->hi[a]);
        box->origin[a] = v_splat(from->fast.origin[a]);
        box->H[a] = v_splat(from->fast.H[a]);
        box->C[a] = v_splat(from->fast.C[a]);
    }
}

/* Of bounds that are floats: so that the flag shows whether H is rounded. */
TRIBOX_INLINE void splat_float_bounds(lane_box *box, const tribox_rounded_box *from)
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

/*
 * What a walk is compiled for, a constant of each instance: its sequence and these bits. In one number, as compilers fold a number
 * while they inline, and a structure only later: kernels take half as long to compile.
 */
typedef uint32_t walk_kind;
enum {
    WALKS_BY_MARGIN = 0,
    WALKS_BY_SIGN = 1 << 10,
    WALKS_SOUP = 1 << 11,  /* triangles and one box; else one triangle and boxes */
    WALKS_MESH = 1 << 12,  /* these triangles are corners */
    WALKS_LOCAL = 1 << 13, /* of doubles, relative to the box (local.h) */
    LOOKS_AGAIN = 1 << 14, /* with the second look of ties.h, for which more numbers have to be kept */
    ASKS_FLAG = 1 << 15,   /* by sign, while the inexact flag is watched: the lengths of the box, too */
    WALKS_FEW = 1 << 16    /* packets of which the first lanes alone are pairs, and nothing past these is read */
};

TRIBOX_INLINE unsigned groups_of(walk_kind kind) { return kind & 1023; }

/* A packet of pairs. The one box, or the one triangle, of a walk is set once. */
typedef struct lane_pairs {
    lane_triangle t;
    lane_box box;
    lane_box_margin margin;
    vmask clear; /* near: the lanes that a box normal does not leave in doubt */
    size_t few;  /* lanes that are pairs, where not all need be */
} lane_pairs;

TRIBOX_INLINE void start_pairs(lane_pairs *p, const tribox_query *from, walk_kind kind)
{
    p->few = V_LANES;
    if (kind & WALKS_SOUP) {
        if (kind & ASKS_FLAG)
            splat_float_bounds(&p->box, from->box);
        else if (kind & WALKS_BY_SIGN)
            splat_fast_box(&p->box, from->box);
        else
            splat_box(&p->box, from->box);
        if (kind & WALKS_LOCAL)
            local_box_at_zero(&p->box);
        if (!(kind & WALKS_BY_SIGN))
            p->margin = kind & WALKS_LOCAL && sequence_has(groups_of(kind), 3) ? local_margin_of(&p->box) : box_margin_of(&p->box);
    } else {
        splat_triangle(&p->t, from->triangle);
    }
}

/* Whether the box normals are tested while loading. */
TRIBOX_INLINE bool is_box_first(unsigned sequence) { return sequence_has(sequence, 1) && !group_alone(sequence); }

TRIBOX_INLINE vnum load_stream(const float *from, size_t few, walk_kind kind)
{
    return kind & WALKS_FEW ? v_load_up_to(from, few) : v_load(from);
}

/* Axis a of a packet that is loaded: its part of *s, and the lanes of `left` that are not apart on its box normal. */
TRIBOX_INLINE uint64_t left_on_axis(lane_pairs *p, int a, walk_kind kind, uint64_t left, lane_shape *s)
{
    shape_axis(s, &p->t, &p->box, a);
    if (kind & LOOKS_AGAIN)
        drop_zero_lengths(s, a);
    if (kind & WALKS_LOCAL)
        p->clear = a == 0 ? is_clear(&p->t, &p->box, a) : m_and(p->clear, is_clear(&p->t, &p->box, a));
    return is_box_first(groups_of(kind)) ? left & ~m_bits(apart_on_box_normal(&p->t, &p->box, a)) : left;
}

/* Axis a of the packet at pair `at`, loaded first: of a soup, of a mesh, or of boxes, those without points left out. */
TRIBOX_INLINE uint64_t load_axis_of_soup(lane_pairs *p, const tribox_query *from, size_t at, int a, walk_kind kind, uint64_t left,
                                         lane_shape *s)
{
    const float *const *const stream = tribox_soup_axis(from->soup, a);
    for (int j = 0; j < 3; j++)
        p->t.u[j][a] = load_stream(stream[j] + at, p->few, kind);
    return left_on_axis(p, a, kind, left, s);
}

TRIBOX_INLINE uint64_t load_axis_of_mesh(lane_pairs *p, const tribox_query *from, size_t at, int a, walk_kind kind, uint64_t left,
                                         lane_shape *s)
{
    if (a == 0 && kind & WALKS_FEW)
        load_places(&p->t, from->corners->place + 3 * at);
    else if (a == 0)
        load_corners(&p->t, from->corners, at, kind & WALKS_LOCAL);
    return left_on_axis(p, a, kind, left, s);
}

TRIBOX_INLINE uint64_t load_axis_of_boxes(lane_pairs *p, const tribox_query *from, size_t at, int a, walk_kind kind, uint64_t left,
                                          lane_shape *s)
{
    const vnum lo = load_stream(from->boxes->lo[a] + at, p->few, kind), hi = load_stream(from->boxes->hi[a] + at, p->few, kind);
    set_bounds(&p->box, a, lo, hi);
    if (kind & WALKS_BY_SIGN)
        p->box.H[a] = v_fma(p->box.H[a], v_splat(V_UNIT), p->box.H[a]); /* as tribox_box_round */
    else if (a == 2)
        p->margin = box_margin_of(&p->box);
    return left_on_axis(p, a, kind, left & m_bits(has_points(lo, hi)), s);
}

/* The same of any of them. */
TRIBOX_INLINE uint64_t load_axis(lane_pairs *p, const tribox_query *from, size_t at, int a, walk_kind kind, uint64_t left,
                                 lane_shape *s)
{
    if (kind & WALKS_MESH)
        return load_axis_of_mesh(p, from, at, a, kind, left, s);
    return kind & WALKS_SOUP ? load_axis_of_soup(p, from, at, a, kind, left, s) : load_axis_of_boxes(p, from, at, a, kind, left, s);
}

TRIBOX_INLINE vmask apart_on_box_normals(const lane_pairs *p)
{
    return m_or(m_or(apart_on_box_normal(&p->t, &p->box, 0), apart_on_box_normal(&p->t, &p->box, 1)),
                apart_on_box_normal(&p->t, &p->box, 2));
}

/* One number for several slacks: the least or, for FAST, any that is negative if one is, as -0 would be (PROOFS.md 10). */
TRIBOX_INLINE vnum worst_of(vnum a, vnum b, walk_kind kind) { return kind & WALKS_BY_SIGN ? v_either(a, b) : v_min(a, b); }

/* The worst of the slacks along e_i and of `worst`, which is that of the projections before it. */
TRIBOX_INLINE vnum worst_edge_along(const lane_shape *s, int i, vnum worst, walk_kind kind)
{
    const edge_slacks slack = edge_slacks_along(s, i, sequence_has(groups_of(kind), 1));
    if (kind & LOOKS_AGAIN)
        return least_number(&slack, i == 0 ? v_splat(INFINITY) : worst);
    const vnum along = worst_of(worst_of(slack.of[0], slack.of[1], kind), slack.of[2], kind);
    return i == 0 ? along : worst_of(worst, along, kind);
}

TRIBOX_INLINE vnum worst_edge(const lane_shape *s, walk_kind kind)
{
    vnum worst = v_splat(0);
    for (int i = 0; i < 3; i++)
        worst = worst_edge_along(s, i, worst, kind);
    return worst;
}

TRIBOX_INLINE vnum plane_slack_for(const lane_shape *s, vnum slack, walk_kind kind)
{
    return kind & LOOKS_AGAIN ? plane_slack_not_redundant(s, slack) : slack;
}

/*
 * Edges and plane in one pass over the projections, n included: they share products, and fewer numbers are kept. Rounded as by
 * worst_edge, plane_reach and plane_slack, so no order changes an answer.
 */
typedef struct joint_slacks {
    vnum edges, plane;
    vnum d; /* of the plane */
} joint_slacks;

TRIBOX_INLINE joint_slacks joint_slacks_of(lane_shape *s, walk_kind kind)
{
    joint_slacks slack = {.edges = v_splat(0), .d = v_splat(0)};
    vnum reach = v_splat(0);
    for (int i = 0; i < 3; i++) {
        shape_normal_along(s, i);
        slack.d = add_to_distance(s, i, slack.d);
        reach = add_to_reach(s, i, reach);
        slack.edges = worst_edge_along(s, i, slack.edges, kind);
    }
    slack.plane = plane_slack_for(s, plane_slack_of(reach, slack.d), kind);
    return slack;
}

/*
 * Lanes without NaN and infinity, which min and max can drop: the d of the plane is finite only where all coordinates are.
 * Without the plane, the sum of the coordinates does the same for less (PROOFS.md 5.4).
 */
TRIBOX_INLINE vmask is_finite_sum(const lane_triangle *t)
{
    vnum sum = v_splat(0);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            sum = v_add(sum, t->u[j][a]);
    return v_gt(v_splat(INFINITY), v_abs(sum));
}

/*
 * FAST: the lanes of `left` that a slack's sign does not separate, d being that of the plane, or 0 where it is not asked. Then only
 * lanes with a finite d are separated: the sign of a NaN means nothing. Without the plane a NaN comes only from coordinates
 * that are not finite, which overlap nothing, or from numbers beyond 2^40.
 */
TRIBOX_INLINE uint64_t left_by_sign(vnum slack, vnum d, uint64_t left, vmask *finite)
{
    *finite = v_gt(v_splat(INFINITY), v_abs(d));
    return left & ~m_bits(m_and(*finite, m_signs(slack)));
}

TRIBOX_INLINE uint64_t left_by_plane_sign(const lane_shape *s, uint64_t left, vmask *finite)
{
    const vnum d = plane_distance(s);
    return left_by_sign(plane_slack_of(plane_reach(s), d), d, left, finite);
}

TRIBOX_INLINE uint64_t left_by_edge_signs(const lane_shape *s, walk_kind kind, uint64_t left, vmask *finite)
{
    return left_by_sign(worst_edge(s, kind), sequence_has(groups_of(kind), 2) ? plane_distance(s) : v_splat(0), left, finite);
}

TRIBOX_INLINE uint64_t left_by_joint_signs(lane_shape *s, walk_kind kind, uint64_t left, vmask *finite)
{
    const joint_slacks joint = joint_slacks_of(s, kind);
    return left_by_sign(v_either(joint.edges, joint.plane), joint.d, left, finite);
}

/*
 * CONSERVATIVE and EXACT: the same of one group, 2 or 3, where the slack is beyond its margin; *certain keeps the lanes beyond it,
 * on the good side. The first slack is computed before the margin, so that fewer numbers are live at a time.
 */
TRIBOX_INLINE uint64_t left_by_margin(const lane_pairs *p, const lane_shape *s, unsigned group, bool is_first, walk_kind kind,
                                      uint64_t left, lane_margin *margin, vmask *certain)
{
    const vnum slack = group == 2 ? plane_slack_for(s, plane_slack(s, plane_reach(s)), kind) : worst_edge(s, kind);
    if (is_first)
        *margin = margin_of(s, &p->margin, sequence_has(groups_of(kind), 1));
    const vnum error = group == 2 ? margin->plane : margin->edges;
    *certain = is_first ? v_gt(slack, error) : m_and(*certain, v_gt(slack, error));
    return left & ~m_bits(m_and(margin->is_valid, v_gt(v_splat(0), v_add(slack, error))));
}

/*
 * EXACT and CONSERVATIVE: the lanes of `left` whose overlap is certain. Each is left by the box normals where they are tested, and
 * has a valid margin and what this table says (PROOFS.md 5.3):
 *
 *   groups                      what a hit needs                         why
 *   box normals                 nothing more                             they compare the input: nothing is rounded
 *   box normals, plane          slack beyond its margin, or redundant    the plane has no side that could be turned
 *   box normals, edges, or all  the same of every slack, and             where an extent is tiny, rounding can turn the sign of
 *                               certifiable extents                      n_i, and an edge's outer side
 *   no box normals              every slack beyond its margin            two-sided slacks have no such sign, nor redundant axes
 *
 * CONSERVATIVE may report too much, and could do with less. It takes the same, so that no answer hangs on where the second look
 * begins. certain: the lanes that have every tested slack beyond its margin; in the second look redundant axes are left out of it.
 */
TRIBOX_INLINE uint64_t certain_overlaps(const lane_shape *s, const lane_box_margin *box, const lane_margin *margin, vmask certain,
                                        walk_kind kind, uint64_t left)
{
    const uint64_t hit = left & m_bits(m_and(certain, margin->is_valid));
    const bool needs_extents = sequence_has(groups_of(kind), 1) && sequence_has(groups_of(kind), 3);
    if (!needs_extents || !(hit & ~m_bits(v_gt(v_splat(0), box->least)))) /* at most 0: no extent matters (PROOFS.md 5.2) */
        return hit;
    return hit & m_bits(are_extents_certifiable(s, box));
}

/* Doubles: not where a box normal is in doubt. */
TRIBOX_INLINE vmask clear_of(const lane_pairs *p, vmask certain, walk_kind kind)
{
    return kind & WALKS_LOCAL ? m_and(certain, p->clear) : certain;
}

/* Where slacks beyond their margins alone make a hit: extents do not matter or, near a box at zero, are large. */
TRIBOX_INLINE vmask needs_no_more(const lane_pairs *p, const lane_shape *s, walk_kind kind)
{
    if (!(kind & WALKS_LOCAL))
        return v_gt(v_splat(0), p->margin.least);
    return m_and(p->clear, v_gt(lane_min3(extent_sum(s, 0), extent_sum(s, 1), extent_sum(s, 2)), p->margin.least));
}

/* FAST: what the signs of the slacks leave, group by group; undecided where a coordinate is not finite. */
TRIBOX_INLINE uint64_t overlaps_by_sign(const lane_pairs *p, lane_shape *s, walk_kind kind, uint64_t left, uint64_t *undecided)
{
    const unsigned groups = groups_of(kind);
    vmask finite = m_all();
    shape_normal(s);
    if (sequence_has(groups, 2))
        left = left_by_plane_sign(s, left, &finite);
    if (sequence_has(groups, 2) && sequence_has(groups, 3) && !left)
        return 0;
    if (sequence_has(groups, 3))
        left = left_by_edge_signs(s, kind, left, &finite);
    if (!sequence_has(groups, 2))
        finite = is_finite_sum(&p->t);
    *undecided = left & ~m_bits(finite);
    return left & m_bits(finite);
}

/* The same, edges and plane together. */
TRIBOX_INLINE uint64_t overlaps_by_joint_signs(const lane_pairs *p, lane_shape *s, walk_kind kind, uint64_t left,
                                               uint64_t *undecided)
{
    vmask finite;
    (void)p;
    left = left_by_joint_signs(s, kind, left, &finite);
    *undecided = left & ~m_bits(finite);
    return left & m_bits(finite);
}

/* EXACT and CONSERVATIVE, group by group: what slacks beyond their margins leave, and undecided where that is not certain. */
TRIBOX_INLINE uint64_t overlaps_by_margin(const lane_pairs *p, lane_shape *s, walk_kind kind, uint64_t left, uint64_t *undecided)
{
    const unsigned groups = groups_of(kind);
    lane_margin margin;
    vmask certain = m_all();
    shape_normal(s);
    if (sequence_has(groups, 2))
        left = left_by_margin(p, s, 2, true, kind, left, &margin, &certain);
    if (sequence_has(groups, 2) && sequence_has(groups, 3) && !left)
        return 0;
    if (sequence_has(groups, 3))
        left = left_by_margin(p, s, 3, !sequence_has(groups, 2), kind, left, &margin, &certain);
    if (groups == 1)
        margin = margin_of(s, &p->margin, true);
    const uint64_t hit = certain_overlaps(s, &p->margin, &margin, clear_of(p, certain, kind), kind, left);
    *undecided = left & ~hit;
    return hit;
}

/*
 * The same, edges and plane together. Where every lane has both slacks beyond their margins, on either side, the signs decide and
 * the rest need not be looked at; a hit then needs extents that do not matter, as in certain_overlaps. In the second look lanes
 * within a margin are common, and this branch would be hard to foresee.
 */
TRIBOX_INLINE uint64_t overlaps_by_joint_margin(const lane_pairs *p, lane_shape *s, walk_kind kind, uint64_t left,
                                                uint64_t *undecided)
{
    const bool is_box_asked = sequence_has(groups_of(kind), 1);
    const vnum zero = v_splat(0);
    const joint_slacks slack = joint_slacks_of(s, kind);
    const lane_margin margin = margin_of(s, &p->margin, is_box_asked);
    const vmask apart = v_gt(zero, v_min(slack.edges, slack.plane));
    vmask decided = m_and(m_and(margin.is_valid, v_gt(v_abs(slack.edges), margin.edges)), v_gt(v_abs(slack.plane), margin.plane));
    if (is_box_asked)
        decided = m_and(decided, m_or(apart, needs_no_more(p, s, kind)));
    if (!(kind & LOOKS_AGAIN) && !(left & ~m_bits(decided)))
        return left & ~m_bits(apart);
    const vmask beyond = m_or(v_gt(zero, v_add(slack.edges, margin.edges)), v_gt(zero, v_add(slack.plane, margin.plane)));
    const vmask certain = m_and(v_gt(slack.edges, margin.edges), v_gt(slack.plane, margin.plane));
    left &= ~m_bits(m_and(margin.is_valid, beyond));
    const uint64_t hit = certain_overlaps(s, &p->margin, &margin, clear_of(p, certain, kind), kind, left);
    *undecided = left & ~hit;
    return hit;
}

/* The lanes that a group alone leaves of all. */
TRIBOX_INLINE uint64_t left_by_group_alone(const lane_pairs *p, lane_shape *s, walk_kind kind, uint64_t left, uint64_t *undecided)
{
    const unsigned group = group_alone(groups_of(kind));
    lane_margin margin;
    vmask unused;
    *undecided = 0;
    shape_normal(s);
    if (!(kind & WALKS_BY_SIGN))
        return left_by_margin(p, s, group, true, kind, left, &margin, &unused);
    if (group == 3 && V_LANES == 1) /* quicker than the edges alone: they share products */
        return left_by_joint_signs(s, kind, left, &unused);
    return group == 2 ? left_by_plane_sign(s, left, &unused) : left_by_edge_signs(s, kind, left, &unused);
}

/*
 * The lanes of the packet at pair `at` that overlap for this kind of walk; in *undecided those that are left to a slower stage.
 * A form of it, of one way to load and one to decide, takes its kinds alone: what each instance would be freed of again takes
 * compilers most of their time.
 */
#define PACKET(form, load, decide) \
    TRIBOX_INLINE uint64_t packet_##form(lane_pairs *p, const tribox_query *from, size_t at, walk_kind kind, uint64_t *undecided) \
    { \
        lane_shape s; \
        *undecided = 0; \
        uint64_t left = load(p, from, at, 0, kind, kind & WALKS_FEW ? LANES_ALL >> (V_LANES - p->few) : LANES_ALL, &s); \
        if (!left) \
            return 0; \
        left = load(p, from, at, 1, kind, left, &s); \
        if (!left) \
            return 0; \
        left = load(p, from, at, 2, kind, left, &s); \
        if (!left) \
            return 0; \
        return decide(p, &s, kind, left, undecided); \
    }
PACKET(soup_joint_BY_MARGIN, load_axis_of_soup, overlaps_by_joint_margin)
PACKET(soup_joint_BY_SIGN, load_axis_of_soup, overlaps_by_joint_signs)
PACKET(soup_apart_BY_MARGIN, load_axis_of_soup, overlaps_by_margin)
PACKET(soup_apart_BY_SIGN, load_axis_of_soup, overlaps_by_sign)
PACKET(soup_alone, load_axis_of_soup, left_by_group_alone)

/*
 * A packet of a soup that a group alone does not reject, from the start: one copy of it, so that walks of such orders are short.
 * Compilers are told that it is called: else they keep numbers in registers, which each call saves.
 */
#define PACKET_ALONE(by) \
    TRIBOX_NOINLINE uint64_t whole_packet_##by(const tribox_query *from, size_t at, uint64_t *undecided) \
    { \
        lane_pairs p; \
        start_pairs(&p, from, 132 | WALKS_SOUP | WALKS_##by); \
        return packet_soup_joint_##by(&p, from, at, 132 | WALKS_SOUP | WALKS_##by, undecided); \
    } \
    TRIBOX_INLINE uint64_t packet_soup_alone_##by(lane_pairs *p, const tribox_query *from, size_t at, walk_kind kind, \
                                                  uint64_t *undecided) \
    { \
        if (TRIBOX_UNLIKELY(!packet_soup_alone(p, from, at, kind, undecided))) \
            return 0; \
        return whole_packet_##by(from, at, undecided); \
    }
PACKET_ALONE(BY_MARGIN)
PACKET_ALONE(BY_SIGN)
