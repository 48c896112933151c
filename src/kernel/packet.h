/*
 * packet.h - one packet of V_LANES pairs at one accuracy and in one sequence of groups, both constants.
 * After: axes.h, margin.h, ties.h.
 *
 * FAST trusts the sign of a computed slack (PROOFS.md 10). CONSERVATIVE and EXACT compare it with its error bound, and leave a
 * lane that has a slack within it to the next stage (doubles.h). What each accuracy needs for a hit: `certain_overlaps`.
 */

TRIBOX_INLINE void splat_triangle(lane_triangle *t, const float triangle[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            t->u[j][a] = v_splat(triangle[j][a]);
}

/*
 * The bounds on one axis. A zero lower bound is -0 and a zero upper bound +0 here, so that u - lo and hi - u are +0, and not
 * negative, for every zero u (PROOFS.md 1, consequence 6).
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

/* What a walk is compiled for: constants of an instance. */
typedef struct walk_kind {
    unsigned sequence;
    tribox_accuracy accuracy;
    bool is_soup;     /* a soup and one box; else one triangle and boxes */
    bool looks_again; /* with the second look of ties.h, for which more numbers have to be kept */
} walk_kind;

/* A packet of pairs. The one box, or the one triangle, of a walk is set once. */
typedef struct lane_pairs {
    lane_triangle t;
    lane_box box;
    lane_box_margin margin;
} lane_pairs;

TRIBOX_INLINE void start_pairs(lane_pairs *p, const tribox_pairs *from, walk_kind kind)
{
    if (kind.is_soup) {
        splat_box(&p->box, from->box);
        p->margin = box_margin_of(&p->box);
    } else {
        splat_triangle(&p->t, from->triangle);
    }
}

/* The box normals that come first are tested while loading. */
TRIBOX_INLINE bool is_box_first(walk_kind kind) { return group_at(kind.sequence, 0) == 1; }

/* Axis a of the packet at pair `at`: its part of *s, and the lanes of `left` that have a box and are not apart on its normal. */
TRIBOX_INLINE uint64_t load_axis(lane_pairs *p, const tribox_pairs *from, size_t at, int a, walk_kind kind, uint64_t left,
                                 lane_shape *s)
{
    if (kind.is_soup) {
        const float *const *const stream = tribox_soup_axis(from->soup, a);
        for (int j = 0; j < 3; j++)
            p->t.u[j][a] = v_load(stream[j] + at);
    } else {
        const vnum lo = v_load(from->boxes->lo[a] + at), hi = v_load(from->boxes->hi[a] + at);
        left &= m_bits(has_points(lo, hi));
        set_bounds(&p->box, a, lo, hi);
    }
    shape_axis(s, &p->t, &p->box, a);
    return is_box_first(kind) ? left & ~m_bits(m_signs(apart_on_box_normal(s, a))) : left;
}

TRIBOX_INLINE vmask apart_on_box_normals(const lane_shape *s)
{
    return m_signs(v_either(v_either(apart_on_box_normal(s, 0), apart_on_box_normal(s, 1)), apart_on_box_normal(s, 2)));
}

TRIBOX_INLINE vnum all_edges_slack(const lane_shape *s, bool is_box_asked)
{
    return is_box_asked ? lane_min3(edges_slack(s, 0), edges_slack(s, 1), edges_slack(s, 2))
                        : lane_min3(edges_slack_both_sides(s, 0), edges_slack_both_sides(s, 1), edges_slack_both_sides(s, 2));
}

/*
 * Bullet 3 for one lane, which stops at the first axis that separates, as in the paper. In a packet some lane nearly always goes
 * on, so it tests all nine at once. *certain loses the lane if a slack is within its bound.
 */
TRIBOX_INLINE uint64_t left_by_each_edge(const lane_shape *s, bool is_box_asked, uint64_t left, vnum error, vmask *certain)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const vnum slack = is_box_asked ? edge_slack(s, i, j) : edge_slack_both_sides(s, i, j);
            if (m_bits(v_gt(v_splat(0), v_add(slack, error))))
                return 0;
            *certain = m_and(*certain, v_gt(slack, error));
        }
    return left;
}

/*
 * Lanes without NaN and infinity, which min and max can drop: the reach of the box along n is finite only where all coordinates
 * are. Without the plane, the sum of the coordinates does the same for less (PROOFS.md 5.4).
 */
TRIBOX_INLINE uint64_t finite_lanes(const lane_triangle *t, unsigned sequence, vnum reach)
{
    if (!sequence_has(sequence, 2)) {
        reach = v_splat(0);
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                reach = v_add(reach, t->u[j][a]);
    }
    return m_bits(v_gt(v_splat(INFINITY), v_abs(reach)));
}

/* FAST: the lanes of `left` that the signs of one group's slacks do not separate; *reach is set by the plane. */
TRIBOX_INLINE uint64_t left_by_sign(const lane_shape *s, unsigned group, bool is_box_asked, uint64_t left, vnum *reach)
{
    if (group == 1)
        left &= ~m_bits(apart_on_box_normals(s));
    if (group == 2) {
        *reach = plane_reach(s);
        left &= ~m_bits(v_gt(v_splat(0), plane_slack(s, *reach)));
    }
    if (group == 3 && V_LANES == 1) {
        vmask certain = m_all();
        return left_by_each_edge(s, is_box_asked, left, v_splat(0), &certain);
    }
    if (group == 3)
        left &= ~m_bits(v_gt(v_splat(0), all_edges_slack(s, is_box_asked)));
    return left;
}

/*
 * CONSERVATIVE and EXACT: the same where the slack is beyond its margin; *certain keeps the lanes beyond it on the good side. The
 * first slack is computed before the margin, so that fewer numbers are live at a time.
 */
TRIBOX_INLINE uint64_t left_by_margin(const lane_shape *s, unsigned group, bool is_box_asked, bool is_first,
                                      const lane_box_margin *box, uint64_t left, lane_margin *margin, vmask *certain)
{
    if (group == 1)
        return left & ~m_bits(apart_on_box_normals(s));
    if (group != 2 && group != 3)
        return left;
    if (group == 3 && V_LANES == 1) {
        if (is_first) {
            *margin = margin_of(s, box, is_box_asked);
            *certain = margin->is_valid;
        }
        return m_bits(margin->is_valid) ? left_by_each_edge(s, is_box_asked, left, margin->edges, certain) : left;
    }
    const vnum slack = group == 2 ? plane_slack(s, plane_reach(s)) : all_edges_slack(s, is_box_asked);
    if (is_first)
        *margin = margin_of(s, box, is_box_asked);
    const vnum error = group == 2 ? margin->plane : margin->edges;
    *certain = is_first ? v_gt(slack, error) : m_and(*certain, v_gt(slack, error));
    return left & ~m_bits(m_and(margin->is_valid, v_gt(v_splat(0), v_add(slack, error))));
}

/*
 * EXACT and CONSERVATIVE: the lanes of `left` whose overlap is certain. Each is left by the box normals where they are tested, and
 * has a valid margin and what this table says (PROOFS.md 5.3):
 *
 *   accuracy       groups                      what a hit needs                         why
 *   EXACT          box normals                 nothing more                             they compare the input: nothing is rounded
 *   EXACT          box normals, plane          slack beyond its margin, or redundant    the plane has no side that could be turned
 *   EXACT          box normals, edges, or all  the same of every slack, and             where an extent is tiny, rounding can turn
 *                                              certifiable extents                      the sign of n_i, and an edge's outer side
 *   EXACT          no box normals              every slack beyond its margin            two-sided slacks have no such sign, and
 *                                                                                       no axis is redundant
 *   CONSERVATIVE   any                         as EXACT, but extents only where         it may report too much: a hit misses
 *                                              an axis is left out as redundant         nothing
 *
 * certain: the lanes that have every tested slack beyond its margin. Redundant axes are left out in the second look alone.
 */
TRIBOX_INLINE uint64_t certain_overlaps(const lane_shape *s, const lane_box_margin *box, const lane_margin *margin, vmask certain,
                                        walk_kind kind, uint64_t left)
{
    const bool has_plane = sequence_has(kind.sequence, 2), has_edges = sequence_has(kind.sequence, 3);
    const bool has_redundant = sequence_has(kind.sequence, 1) && (has_plane || has_edges);
    const bool needs_extents = kind.accuracy == TRIBOX_EXACT && has_redundant && has_edges;
    uint64_t hit = left & m_bits(m_and(certain, margin->is_valid));
    if (needs_extents)
        hit &= m_bits(v_gt(v_splat(0), box->least)); /* no extent matters (PROOFS.md 5.2) */
    if (!(left & ~hit) || !has_redundant || !(needs_extents || kind.looks_again))
        return hit;
    const vmask certifiable = has_edges ? m_and(margin->is_valid, are_extents_certifiable(s, box)) : margin->is_valid;
    hit |= left & m_bits(m_and(certain, certifiable));
    if (!(left & ~hit) || !kind.looks_again)
        return hit;
    const vmask edges = has_edges ? are_edges_certain(s, margin) : m_all();
    const vmask plane = has_plane ? is_plane_certain(s, margin) : m_all();
    return hit | (left & m_bits(m_and(certifiable, m_and(edges, plane))));
}

/* FAST: what the signs of the slacks leave; open where a coordinate is not finite. */
TRIBOX_INLINE uint64_t overlaps_by_sign(const lane_pairs *p, const lane_shape *s, walk_kind kind, uint64_t left, uint64_t *open)
{
    const bool is_box_asked = sequence_has(kind.sequence, 1);
    vnum reach = v_splat(0);
    left = left_by_sign(s, is_box_first(kind) ? 0 : group_at(kind.sequence, 0), is_box_asked, left, &reach);
    if (!left)
        return 0;
    left = left_by_sign(s, group_at(kind.sequence, 1), is_box_asked, left, &reach);
    if (!left)
        return 0;
    left = left_by_sign(s, group_at(kind.sequence, 2), is_box_asked, left, &reach);
    const uint64_t finite = finite_lanes(&p->t, kind.sequence, reach);
    *open = left & ~finite;
    return left & finite;
}

/* EXACT and CONSERVATIVE: what slacks beyond their margins leave, and open where that is not certain. */
TRIBOX_INLINE uint64_t overlaps_by_margin(lane_pairs *p, const lane_shape *s, walk_kind kind, uint64_t left, uint64_t *open)
{
    const unsigned sequence = kind.sequence;
    const unsigned first = is_box_first(kind) ? 0 : group_at(sequence, 0), second = group_at(sequence, 1);
    const bool is_box_asked = sequence_has(sequence, 1);
    lane_margin margin;
    vmask certain = m_all();
    if (!kind.is_soup)
        p->margin = box_margin_of(&p->box);
    left = left_by_margin(s, first, is_box_asked, true, &p->margin, left, &margin, &certain);
    if (!left)
        return 0;
    left = left_by_margin(s, second, is_box_asked, first < 2, &p->margin, left, &margin, &certain);
    if (!left)
        return 0;
    left = left_by_margin(s, group_at(sequence, 2), is_box_asked, first < 2 && second < 2, &p->margin, left, &margin, &certain);
    if (sequence == 1)
        margin = margin_of(s, &p->margin, is_box_asked);
    const uint64_t hit = certain_overlaps(s, &p->margin, &margin, certain, kind, left);
    *open = left & ~hit;
    return hit;
}

/* The lanes of the packet at pair `at` that overlap at this accuracy; in *open those that are left to a slower stage. */
TRIBOX_INLINE uint64_t packet(lane_pairs *p, const tribox_pairs *from, size_t at, walk_kind kind, uint64_t *open)
{
    lane_shape s;
    *open = 0;
    uint64_t left = load_axis(p, from, at, 0, kind, LANES_ALL, &s);
    if (!left)
        return 0;
    left = load_axis(p, from, at, 1, kind, left, &s);
    if (!left)
        return 0;
    left = load_axis(p, from, at, 2, kind, left, &s);
    if (!left)
        return 0;
    shape_normal(&s);
    return kind.accuracy == TRIBOX_FAST ? overlaps_by_sign(p, &s, kind, left, open) : overlaps_by_margin(p, &s, kind, left, open);
}
