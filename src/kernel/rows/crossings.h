/*
 * crossings.h - triangles and the rays along x through the middles of rows of cells, and where they cross: in lanes of double, and
 * by exact signs where rounding could turn one (PROOFS.md 15.4). After: axes.h, fill_crossings.h.
 *
 * A triangle and a row whose middle its box may hold are a pair. Triangles of few pairs are taken a packet at once; of others, a
 * packet of pairs.
 */
static const double FEW_PAIRS = 16;

/* The nearest whole number, for sizes below 2^51. */
TRIBOX_INLINE vnum whole_near(vnum a) { return v_sub(v_add(a, v_splat(0x1.8p52)), v_splat(0x1.8p52)); }

/* The pairs of a triangle: the first row on y and z, how many rows there are on y, and pairs in all. */
typedef struct row_pairs {
    double first[2], across, count;
} row_pairs;

/* Triangles of few pairs. */
typedef struct few_pairs {
    tribox_seen_along seen;
    double first[2][TRIBOX_SEEN_ALONG], across[TRIBOX_SEEN_ALONG], pairs[TRIBOX_SEEN_ALONG];
    unsigned count;
} few_pairs;

/* Rows of an axis that boxes of triangles may hold a middle of. */
typedef struct lane_middles {
    vnum first, count;
} lane_middles;

/* On axis a, y or z. The middle of cell j has the place j + 1/2. */
TRIBOX_INLINE lane_middles middles_of(const tribox_middles *m, int a, const tribox_seen_along *seen, size_t at)
{
    const vnum u[3] = {v_read(seen->number[3 * a] + at), v_read(seen->number[3 * a + 1] + at),
                       v_read(seen->number[3 * a + 2] + at)};
    const vnum origin = v_splat(m->origin[a]), per_cell = v_splat(m->per_cell[a]), error = v_splat(m->error[a]);
    const vnum size = v_splat(m->size[a]), one = v_splat(1), zero = v_splat(0);
    const vnum least = v_mul(v_sub(lane_min3(u[0], u[1], u[2]), origin), per_cell);
    const vnum most = v_mul(v_sub(lane_max3(u[0], u[1], u[2]), origin), per_cell);
    const vnum from = v_max(v_min(v_sub(least, error), size), zero);
    const vnum to = v_min(v_max(v_add(v_sub(most, one), error), v_splat(-1)), v_sub(size, one));
    const vnum first = whole_near(from);
    return (lane_middles){first, v_add(v_sub(whole_near(to), first), one)};
}

/* Triangles as they are seen along x, and what rounding can do to them. */
typedef struct lane_seen {
    vnum x, y[3], z[3];       /* x is that of vertex 0 */
    vnum lo[2], hi[2];        /* their boxes on y and z, and what middles can be off by */
    vnum dx[2], dy[3], dz[3]; /* of vertices 1 and 2 from vertex 0; of edge j, from vertex j on */
    vnum area, per_area;      /* n_x */
    vnum error;               /* of a side */
    vnum place_error;         /* of a crossing, in cells */
    vnum first[2], across;    /* as in row_pairs */
    vnum per_across;
    vmask is_certain; /* the sign of n_x, and that places are told within a quarter of a cell */
} lane_seen;

TRIBOX_INLINE void find_edges(lane_seen *s, const vnum u[9])
{
    s->x = u[0];
    for (int j = 0; j < 3; j++) {
        s->y[j] = u[3 + j];
        s->z[j] = u[6 + j];
        s->dy[j] = v_sub(u[3 + (j + 1) % 3], u[3 + j]);
        s->dz[j] = v_sub(u[6 + (j + 1) % 3], u[6 + j]);
    }
    for (int j = 0; j < 2; j++)
        s->dx[j] = v_sub(u[1 + j], u[0]);
    s->area = v_fms(s->dy[0], s->dz[1], v_mul(s->dz[0], s->dy[1]));
    s->per_area = v_div(v_splat(1), s->area);
}

/* What rounding can do to a side, and to n_x, of a triangle with these extents on y and z. */
TRIBOX_INLINE vnum side_error(vnum F_y, vnum F_z) { return v_mul(v_splat(16 * V_UNIT), v_mul(F_y, F_z)); }

/* Of triangles that are not finite nothing is certain. */
TRIBOX_INLINE void see(lane_seen *s, const tribox_middles *m, const vnum u[9])
{
    const vnum many = v_splat(0x1p300), off_y = v_splat(m->off[1]), off_z = v_splat(m->off[2]);
    vnum F[3];
    find_edges(s, u);
    for (int a = 0; a < 3; a++) {
        const vnum off = v_splat(a ? m->off[a] : 0);
        const vnum lo = v_sub(lane_min3(u[3 * a], u[3 * a + 1], u[3 * a + 2]), off);
        const vnum hi = v_add(lane_max3(u[3 * a], u[3 * a + 1], u[3 * a + 2]), off);
        F[a] = v_sub(hi, lo);
        if (a) {
            s->lo[a - 1] = lo;
            s->hi[a - 1] = hi;
        }
    }
    const vnum of_middles = v_add(v_mul(F[1], off_z), v_mul(F[2], off_y));
    s->error = v_add(v_add(side_error(F[1], F[2]), of_middles), v_splat(0x1p-1000));
    const vnum of_sides = v_mul(v_mul(v_splat(8), s->error), v_abs(s->per_area));
    const vnum of_place = v_mul(v_mul(F[0], v_add(of_sides, v_splat(0x1p-49))), v_splat(m->per_cell[0]));
    s->place_error = v_add(v_add(of_place, v_splat(m->error[0])), lane_lost3(u[0], u[1], u[2]));
    s->is_certain = m_and(v_gt(v_abs(s->area), v_mul(v_splat(16), s->error)), v_gt(v_splat(0.25), s->place_error));
    for (int a = 0; a < 3; a++)
        s->is_certain = m_andnot(s->is_certain, m_not(v_gt(many, F[a])));
}

TRIBOX_INLINE void set_pairs(lane_seen *s, vnum first_y, vnum first_z, vnum across)
{
    s->first[0] = first_y;
    s->first[1] = first_z;
    s->across = across;
    s->per_across = v_div(v_splat(1), across);
}

/* The middle of a cell, but for `off`: planes are rounded once, which takes its time. */
TRIBOX_INLINE vnum middle_near(const tribox_middles *m, int a, vnum cell)
{
    return v_add(v_splat(m->origin[a]), v_mul(v_add(cell, v_splat(0.5)), v_splat(m->cell[a])));
}

TRIBOX_INLINE vmask is_within(vnum a, vnum lo, vnum hi) { return m_not(m_or(v_gt(lo, a), v_gt(a, hi))); }

/* On which side of edge e the ray at (y, z) is. */
TRIBOX_INLINE vnum side_of_edge(const lane_seen *s, int e, vnum y, vnum z)
{
    return v_fms(s->dy[e], v_sub(z, s->z[e]), v_mul(s->dz[e], v_sub(y, s->y[e])));
}

/* How far past vertex 0 the ray of these sides crosses. Two lengths are divided by two: three multiplied could vanish. */
TRIBOX_INLINE vnum crossing_past(const lane_seen *s, vnum side_0, vnum side_2)
{
    const vnum weight[2] = {v_mul(side_2, s->per_area), v_mul(side_0, s->per_area)};
    return v_fma(weight[0], s->dx[0], v_mul(weight[1], s->dx[1]));
}

/* The pair `number` of each triangle, line by line: its row, where that crosses, and where exact signs have to tell. */
typedef struct lane_crossing {
    vnum row[2], cell;
    vmask crossed, undecided;
} lane_crossing;

TRIBOX_INLINE lane_crossing cross_pairs(const tribox_middles *m, const lane_seen *s, vnum number)
{
    const vnum half = v_splat(0.5), line = whole_near(v_sub(v_mul(v_add(number, half), s->per_across), half));
    lane_crossing c = {.row = {v_add(s->first[0], v_sub(number, v_mul(line, s->across))), v_add(s->first[1], line)}};
    const vnum y = middle_near(m, 1, c.row[0]), z = middle_near(m, 2, c.row[1]);
    vnum side[3];
    for (int e = 0; e < 3; e++)
        side[e] = side_of_edge(s, e, y, z);
    const vnum least = lane_min3(v_flip(side[0], s->area), v_flip(side[1], s->area), v_flip(side[2], s->area));
    const vnum x = v_add(s->x, crossing_past(s, side[0], side[2]));
    const vnum place = v_mul(v_sub(x, v_splat(m->origin[0])), v_splat(m->per_cell[0]));
    const vnum inside = v_min(v_max(place, v_splat(m->least)), v_splat(m->size[0]));
    c.cell = whole_near(inside);
    const vmask is_told = v_gt(v_sub(half, s->place_error), v_abs(v_sub(inside, c.cell)));
    const vmask is_past = v_gt(least, s->error), is_beside = v_gt(v_sub(v_splat(0), s->error), least);
    const vmask is_in_box = m_and(is_within(y, s->lo[0], s->hi[0]), is_within(z, s->lo[1], s->hi[1]));
    c.crossed = m_and(m_and(is_past, is_told), is_in_box);
    c.undecided = m_andnot(is_in_box, m_or(m_and(is_past, is_told), is_beside));
    return c;
}

TRIBOX_INLINE void read_seen(const tribox_seen_along *seen, size_t at, double u[3][3])
{
    for (int n = 0; n < 9; n++)
        u[n % 3][n / 3] = seen->number[n][at];
}

/* Lists what crosses, and settles what is undecided, of triangle `first` + lane * `step`. */
TRIBOX_INLINE void turn_pairs(tribox_crossings *c, const lane_crossing *found, vmask of, const tribox_seen_along *seen,
                              size_t first, size_t step)
{
    double row[2][V_LANES], cell[V_LANES];
    v_write(row[0], found->row[0]);
    v_write(row[1], found->row[1]);
    v_write(cell, found->cell);
    for (uint64_t crossed = m_bits(m_and(found->crossed, of)); crossed; crossed &= crossed - 1) {
        const unsigned n = tribox_lowest_bit(crossed);
        tribox_crossings_turn(c, (int64_t)row[0][n], (int64_t)row[1][n], (int64_t)cell[n]);
    }
    for (uint64_t undecided = m_bits(m_and(found->undecided, of)); undecided; undecided &= undecided - 1) {
        const unsigned n = tribox_lowest_bit(undecided);
        double u[3][3];
        read_seen(seen, first + n * step, u);
        c->handlers->add_row(c, u, (int64_t)row[0][n], (int64_t)row[1][n]);
    }
}

static const double LANE_NUMBERS[TRIBOX_DOUBLES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7};

/* By exact signs: triangles from `first` on. */
static void settle_triangles(tribox_crossings *c, const tribox_seen_along *seen, size_t first, uint64_t lanes)
{
    for (; lanes; lanes &= lanes - 1) {
        double u[3][3];
        read_seen(seen, first + tribox_lowest_bit(lanes), u);
        c->handlers->add_doubtful(c, u);
    }
}

/* A packet of triangles, pair by pair. */
static void cross_packet(tribox_crossings *c, const few_pairs *few, size_t first)
{
    const size_t count = few->count - first < V_LANES ? few->count - first : V_LANES;
    const vmask is_there = v_gt(v_splat((double)count), v_read(LANE_NUMBERS));
    const vnum pairs = v_read(few->pairs + first);
    double most = 0;
    lane_seen s;
    vnum u[9];
    for (int n = 0; n < 9; n++)
        u[n] = v_read(few->seen.number[n] + first);
    see(&s, &c->middles, u);
    set_pairs(&s, v_read(few->first[0] + first), v_read(few->first[1] + first), v_read(few->across + first));
    settle_triangles(c, &few->seen, first, m_bits(m_andnot(is_there, s.is_certain)));
    for (size_t n = first; n < first + count; n++)
        most = few->pairs[n] > most ? few->pairs[n] : most;
    for (double number = 0; number < most; number++) {
        const vmask has_pair = m_and(m_and(is_there, s.is_certain), v_gt(pairs, v_splat(number)));
        const lane_crossing found = cross_pairs(&c->middles, &s, v_splat(number));
        turn_pairs(c, &found, has_pair, &few->seen, first, 1);
    }
}

/* One triangle, a packet of its pairs at a time. */
static void cross_one(tribox_crossings *c, const tribox_seen_along *seen, size_t at, const row_pairs *p)
{
    lane_seen s;
    vnum u[9];
    for (int n = 0; n < 9; n++)
        u[n] = v_splat(seen->number[n][at]);
    see(&s, &c->middles, u);
    set_pairs(&s, v_splat(p->first[0]), v_splat(p->first[1]), v_splat(p->across));
    if (!m_bits(s.is_certain)) {
        settle_triangles(c, seen, at, 1);
        return;
    }
    for (double from = 0; from < p->count; from += V_LANES) {
        const vnum number = v_add(v_splat(from), v_read(LANE_NUMBERS));
        const lane_crossing found = cross_pairs(&c->middles, &s, number);
        turn_pairs(c, &found, v_gt(v_splat(p->count), number), seen, at, 0);
    }
}

TRIBOX_INLINE void join_few(few_pairs *few, const tribox_seen_along *seen, size_t at, const row_pairs *p)
{
    for (int n = 0; n < 9; n++)
        few->seen.number[n][few->count] = seen->number[n][at];
    few->first[0][few->count] = p->first[0];
    few->first[1][few->count] = p->first[1];
    few->across[few->count] = p->across;
    few->pairs[few->count++] = p->count;
}

/* A packet of the triangles: those of many pairs are crossed, those of few join the others. */
TRIBOX_INLINE void cross_or_join(tribox_crossings *c, const tribox_seen_along *seen, size_t at, size_t count, few_pairs *few)
{
    const lane_middles y = middles_of(&c->middles, 1, seen, at), z = middles_of(&c->middles, 2, seen, at);
    const vmask is_there = v_gt(v_splat((double)(count - at)), v_read(LANE_NUMBERS));
    double first[2][V_LANES], across[V_LANES], pairs[V_LANES];
    v_write(first[0], y.first);
    v_write(first[1], z.first);
    v_write(across, y.count);
    v_write(pairs, v_mul(y.count, z.count));
    const vmask has_pairs = m_and(v_gt(y.count, v_splat(0)), v_gt(z.count, v_splat(0)));
    for (uint64_t lanes = m_bits(m_and(has_pairs, is_there)); lanes; lanes &= lanes - 1) {
        const unsigned n = tribox_lowest_bit(lanes);
        const row_pairs p = {{first[0][n], first[1][n]}, across[n], pairs[n]};
        if (p.count > FEW_PAIRS)
            cross_one(c, seen, at + n, &p);
        else
            join_few(few, seen, at + n, &p);
    }
}

/* What fills the last packet has no pairs. */
static void cross_triangles(tribox_crossings *c, const tribox_seen_along *seen, size_t count)
{
    static const tribox_seen_along none;
    few_pairs few;
    few.count = 0;
    for (size_t at = 0; at < count; at += V_LANES)
        cross_or_join(c, seen, at, count, &few);
    const unsigned joined = few.count;
    while (few.count % V_LANES)
        join_few(&few, &none, 0, &(row_pairs){.across = 1});
    few.count = joined;
    for (size_t first = 0; first < few.count; first += V_LANES)
        cross_packet(c, &few, first);
}
