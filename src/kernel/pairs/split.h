/*
 * split.h - triangles against the eight children of a box, a packet at a time: edges, normal and margin once for all of them.
 * After: axes.h, margin.h, ties.h, packet.h, tail.h.
 *
 * Along each axis a child is the lower or the upper half of the box. A projection along e_i knows two axes, so its slacks are those
 * of four children, twice: twelve times three edges answer for all eight. Each is rounded as by a walk about the child alone, and
 * compared with the margin of the widest (PROOFS.md 5.5). The second look of ties.h costs little, where eight children share it.
 */

/* The halves of a box on each axis: the lower, the upper. */
typedef struct lane_halves {
    lane_box box[2];
    vnum origin[2][3];
    lane_box_margin margin; /* of every child */
} lane_halves;

/* The margin of children that have either half on each axis: a margin grows with the sides, and with what lies near zero. */
TRIBOX_INLINE lane_box_margin margin_of_children(const lane_box box[2], walk_kind kind)
{
    const lane_box_margin low = box_margin_of(&box[0]), high = box_margin_of(&box[1]);
    lane_box_margin margin = {v_min(low.most, high.most), v_max(low.least, high.least), v_max(low.edges, high.edges),
                              v_max(low.eta, high.eta)};
    vnum thinnest = v_splat(INFINITY), longest = v_splat(0);
    for (int a = 0; a < 3; a++) {
        thinnest = v_min(thinnest, v_min(box[0].H[a], box[1].H[a]));
        longest = v_max(longest, v_max(box[0].H[a], box[1].H[a]));
    }
    if (kind & WALKS_LOCAL && groups_of(kind) != 1)
        margin.most = v_min(margin.most, local_most(thinnest, longest));
    return margin;
}

TRIBOX_INLINE void start_halves(lane_halves *h, const tribox_halves *from, walk_kind kind)
{
    for (int half = 0; half < 2; half++) {
        const tribox_rounded_box *const box = &from->half[half];
        const tribox_box_floats *const of = kind & WALKS_BY_SIGN ? &box->fast : &box->of;
        for (int a = 0; a < 3; a++) {
            h->box[half].lo[a] = v_splat(box->lo[a]);
            h->box[half].hi[a] = v_splat(box->hi[a]);
            h->box[half].H[a] = v_splat(of->H[a]);
            h->box[half].C[a] = v_splat(of->C[a]);
            h->origin[half][a] = v_splat(of->origin[a]);
        }
    }
    h->margin = margin_of_children(h->box, kind);
}

/* A packet: what its children share, and what they do not. */
typedef struct lane_split {
    lane_shape s;      /* but for V and H */
    vnum V[2][3];      /* about the middle of each half */
    vmask apart[2][3]; /* from it, by the normal of the axis */
    vmask clear[2][3]; /* doubles: lanes that this normal does not leave in doubt */
    vmask inside;      /* of one child, without touching its faces */
} lane_split;

TRIBOX_INLINE void split_axis(lane_split *p, const lane_halves *h, const vnum u[3], int a, walk_kind kind)
{
    const vnum least = lane_min3(u[0], u[1], u[2]), most = lane_max3(u[0], u[1], u[2]);
    for (int half = 0; half < 2; half++) {
        const lane_box *const box = &h->box[half];
        p->V[half][a] = v_fms(v_splat(2), v_sub(u[0], h->origin[half][a]), box->C[a]);
        p->apart[half][a] = m_or(v_gt(box->lo[a], most), v_gt(least, box->hi[a]));
        if (kind & WALKS_LOCAL)
            p->clear[half][a] = m_and(v_gt(most, box->lo[a]), v_gt(box->hi[a], least));
    }
    for (int j = 0; j < 3; j++) {
        p->s.f[j][a] = v_sub(u[(j + 1) % 3], u[j]);
        p->s.l[j][a] = v_abs(p->s.f[j][a]);
    }
    const vmask within = m_and(v_gt(least, h->box[0].lo[a]), v_gt(h->box[1].hi[a], most));
    const vmask one = m_and(within, m_or(p->apart[0][a], p->apart[1][a]));
    p->inside = a == 0 ? one : m_and(p->inside, one);
}

/* The shape about a child: half of[a] on axis a. Axes that are not asked of are left out by the compiler. */
TRIBOX_INLINE lane_shape shape_of_child(const lane_split *p, const lane_halves *h, int x, int y, int z)
{
    const int of[3] = {x, y, z};
    lane_shape s = p->s;
    for (int a = 0; a < 3; a++) {
        s.V[a] = p->V[of[a]][a];
        s.H[a] = h->box[of[a]].H[a];
    }
    return s;
}

/* The least slack of the edges along e_i, by the halves on the two axes after it. FAST too has masks of it, not signs alone. */
typedef struct edges_of_children {
    vnum worst[3][2][2];
} edges_of_children;

TRIBOX_INLINE void test_edges(const lane_split *p, const lane_halves *h, int i, int first, int second, walk_kind kind,
                              edges_of_children *edges)
{
    const lane_shape s = i == 0   ? shape_of_child(p, h, 0, first, second)
                         : i == 1 ? shape_of_child(p, h, second, 0, first)
                                  : shape_of_child(p, h, first, second, 0);
    edges->worst[i][first][second] = worst_edge_along(&s, i, v_splat(INFINITY), 132 | WALKS_SOUP | (kind & LOOKS_AGAIN));
}

TRIBOX_INLINE void test_edges_along(const lane_split *p, const lane_halves *h, int i, walk_kind kind, edges_of_children *edges)
{
    test_edges(p, h, i, 0, 0, kind, edges);
    test_edges(p, h, i, 0, 1, kind, edges);
    test_edges(p, h, i, 1, 0, kind, edges);
    test_edges(p, h, i, 1, 1, kind, edges);
}

TRIBOX_INLINE vnum edges_of_child(const edges_of_children *edges, int x, int y, int z)
{
    return lane_min3(edges->worst[0][y][z], edges->worst[1][z][x], edges->worst[2][x][y]);
}

/* Children as bits: bit c of a lane is child c. Those of the lower half on an axis, and of the upper. */
TRIBOX_INLINE vint children_of(vint low, vint high, int a)
{
    const int of_low[3] = {0x55, 0x33, 0x0f};
    return i_or(i_and(low, i_splat(of_low[a])), i_and(high, i_splat(of_low[a] ^ 0xff)));
}

/* Those in whose halves the masks are set, on all axes. */
TRIBOX_INLINE vint children_in(vmask half[2][3])
{
    const vint all = i_splat(0xff);
    return i_and(children_of(i_keep(half[0][0], all), i_keep(half[1][0], all), 0),
                 i_and(children_of(i_keep(half[0][1], all), i_keep(half[1][1], all), 1),
                       children_of(i_keep(half[0][2], all), i_keep(half[1][2], all), 2)));
}

/* Children that box normals leave. */
TRIBOX_INLINE vint children_left(const lane_split *p)
{
    vmask left[2][3];
    for (int half = 0; half < 2; half++)
        for (int a = 0; a < 3; a++)
            left[half][a] = m_not(p->apart[half][a]);
    return children_in(left);
}

/* What slacks say of the children. */
typedef struct lane_children {
    vint apart, certain;
} lane_children;

TRIBOX_INLINE void test_child(const lane_split *p, const lane_halves *h, const edges_of_children *edges, const lane_margin *margin,
                              walk_kind kind, int c, lane_children *said)
{
    const int x = c & 1, y = c >> 1 & 1, z = c >> 2;
    const lane_shape s = shape_of_child(p, h, x, y, z);
    const vnum edge = edges_of_child(edges, x, y, z), plane = plane_slack_for(&s, plane_slack(&s, plane_reach(&s)), kind);
    const vnum zero = v_splat(0);
    vmask apart = v_gt(zero, v_min(edge, plane));
    if (!(kind & WALKS_BY_SIGN)) {
        const vmask certain = m_and(v_gt(edge, margin->edges), v_gt(plane, margin->plane));
        apart = m_or(v_gt(zero, v_add(edge, margin->edges)), v_gt(zero, v_add(plane, margin->plane)));
        said->certain = i_or(said->certain, i_keep(certain, i_splat(1 << c)));
    }
    said->apart = i_or(said->apart, i_keep(apart, i_splat(1 << c)));
}

/* Four calls above, eight here, and no loop: compilers keep one as large as this, and with it what it takes in memory. */
TRIBOX_INLINE lane_children test_children(lane_split *p, const lane_halves *h, const lane_margin *margin, walk_kind kind)
{
    edges_of_children edges;
    lane_children said = {i_splat(0), i_splat(0)};
    shape_normal(&p->s);
    test_edges_along(p, h, 0, kind, &edges);
    test_edges_along(p, h, 1, kind, &edges);
    test_edges_along(p, h, 2, kind, &edges);
    test_child(p, h, &edges, margin, kind, 0, &said);
    test_child(p, h, &edges, margin, kind, 1, &said);
    test_child(p, h, &edges, margin, kind, 2, &said);
    test_child(p, h, &edges, margin, kind, 3, &said);
    test_child(p, h, &edges, margin, kind, 4, &said);
    test_child(p, h, &edges, margin, kind, 5, &said);
    test_child(p, h, &edges, margin, kind, 6, &said);
    test_child(p, h, &edges, margin, kind, 7, &said);
    if (kind & WALKS_BY_SIGN)
        said.certain = i_andnot(i_splat(0xff), said.apart);
    return said;
}

/* Hits, and 8 bits higher what is left undecided; as certain_overlaps and overlaps_by_sign have it. */
TRIBOX_INLINE vint split_packet(const tribox_soup *soup, const lane_halves *h, size_t at, walk_kind kind)
{
    lane_split p;
    for (int a = 0; a < 3; a++) {
        const float *const *const stream = tribox_soup_axis(soup, a);
        const vnum u[3] = {v_load(stream[0] + at), v_load(stream[1] + at), v_load(stream[2] + at)};
        split_axis(&p, h, u, a, kind);
    }
    const lane_margin margin = margin_of(&p.s, &h->margin, true);
    const vint all = i_splat(0xff), left = children_left(&p), inside = i_keep(m_and(p.inside, margin.is_valid), left);
    const vint open = i_andnot(left, inside), clear = kind & WALKS_LOCAL ? children_in(p.clear) : all;
    if (!m_bits(m_has_bits(open)))
        return left;
    const vint valid = i_keep(margin.is_valid, all);
    vint hit, miss = i_splat(0);
    if (groups_of(kind) != 1) {
        const vmask certifiable =
            kind & WALKS_BY_SIGN ? margin.is_valid : m_and(margin.is_valid, are_extents_certifiable(&p.s, &h->margin));
        for (int a = 0; kind & LOOKS_AGAIN && a < 3; a++)
            drop_zero_lengths(&p.s, a);
        const lane_children said = test_children(&p, h, &margin, kind);
        miss = i_and(said.apart, valid);
        hit = i_keep(certifiable, i_and(said.certain, clear));
    } else {
        hit = i_and(valid, clear);
    }
    const vint found = i_or(inside, i_and(open, hit)), undecided = i_andnot(i_andnot(open, hit), miss);
    return i_or(found, i_shl(undecided, i_splat(8)));
}

/* The last packet ends with the last triangle, and writes again what the one before it has written. */
TRIBOX_INLINE bool split_all(const tribox_soup *soup, const tribox_halves *from, int32_t *bits, walk_kind kind)
{
    lane_halves h;
    vint any = i_splat(0);
    start_halves(&h, from, kind);
    for (size_t done = 0; done < soup->count; done += V_LANES) {
        const size_t at = soup->count - done < V_LANES ? soup->count - V_LANES : done;
        const vint of_packet = split_packet(soup, &h, at, kind);
        any = i_or(any, of_packet);
        i_write(bits + at, of_packet);
    }
    return m_bits(m_has_bits(i_and(any, i_splat(0xff00))));
}

/* A small build has one instance, which asks as it runs what others know as they are compiled; it has no BY_SIGN. */
#if defined(TRIBOX_SMALL)
TRIBOX_NOINLINE bool split_any(const tribox_soup *soup, const tribox_halves *from, int32_t *bits, walk_kind kind)
{
    return split_all(soup, from, bits, (kind & ~WALKS_BY_SIGN) | WALKS_SOUP | LOOKS_AGAIN);
}
#else
#define split_any split_all
#endif

#define SPLIT_BY(name, kind) \
    static bool split_##name(const tribox_soup *soup, const tribox_halves *from, int32_t *bits) \
    { \
        return split_any(soup, from, bits, kind); \
    }
SPLIT_BY(by_margin, 132 | WALKS_SOUP | LOOKS_AGAIN)
SPLIT_BY(by_sign, 132 | WALKS_SOUP | WALKS_BY_SIGN)
SPLIT_BY(local, 132 | WALKS_SOUP | WALKS_LOCAL | LOOKS_AGAIN)
SPLIT_BY(box, 1 | WALKS_SOUP)
SPLIT_BY(local_box, 1 | WALKS_SOUP | WALKS_LOCAL)
