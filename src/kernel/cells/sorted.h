/*
 * sorted.h - a soup walked for a grid: packets of triangles, sorted by the cells that their bounding boxes touch. Of
 * doubles it holds the floats that stand for them. After: solids.h, flats.h, bricks.h. Needs: KERNEL.
 *
 * One cell, or a line of few, is listed at once, as a connected triangle overlaps all of it (PROOFS.md 7.4). Flats and solids of
 * few cells wait in queues until they fill a packet. Larger ones are deferred, one by one. Nothing that decides depends on the
 * layers asked for, or on company (PROOFS.md 7.9).
 */

TRIBOX_INLINE int32_t number_of(const lane_reach *r, unsigned lane) { return r->number ? r->number[lane] : 0; }

static void defer(tribox_voxels *v, lane_reach r, uint64_t lanes)
{
    float u[9][V_LANES], base[3][V_LANES], cells[3][V_LANES];
    uint64_t spans[3];
    for (int n = 0; n < 9; n++)
        v_write(u[n], r.u[n]);
    for (int a = 0; a < 3; a++) {
        v_write(base[a], r.base[a]);
        v_write(cells[a], r.cells[a]);
        spans[a] = m_bits(r.spans[a]);
    }
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = tribox_lowest_bit(lanes);
        const tribox_triangle triangle = triangle_of_lane(v, &u[0][lane], V_LANES, number_of(&r, lane));
        tribox_cell_range range;
        for (int a = 0; a < 3; a++) {
            range.base[a] = (int64_t)base[a][lane];
            range.cells[a] = (int64_t)cells[a][lane];
            range.spans[a] = spans[a] >> lane & 1;
        }
        v->sinks.handlers->take_triangle(v, &triangle, &range);
    }
}

/* Triangles that are not known to be finite, or blurred. */
TRIBOX_NOINLINE void add_each(tribox_voxels *v, lane_reach r, uint64_t lanes)
{
    float u[9][V_LANES];
    for (int n = 0; n < 9; n++)
        v_write(u[n], r.u[n]);
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = tribox_lowest_bit(lanes);
        const tribox_triangle triangle = triangle_of_lane(v, &u[0][lane], V_LANES, number_of(&r, lane));
        v->sinks.handlers->add_triangle(v, &triangle);
    }
}

/* These lanes of the packet of a queue that begins at place `at`. A small build asks as it runs what others know as compiled. */
TRIBOX_NOINLINE void set_queued(tribox_voxels *v, tribox_class kind, unsigned at, vmask asked)
{
    const tribox_queue *const queue = &v->sinks.queue[kind];
    const bool is_exact = v->plan.accuracy == TRIBOX_EXACT;
#if defined(TRIBOX_SMALL)
    if (kind == TRIBOX_FLATS)
        set_flats(v, queue, at, asked, is_exact);
    else
        set_solids(v, queue, at, asked, is_exact);
#else
    if (kind == TRIBOX_FLATS && is_exact)
        set_flats(v, queue, at, asked, true);
    else if (kind == TRIBOX_FLATS)
        set_flats(v, queue, at, asked, false);
    else if (is_exact)
        set_solids(v, queue, at, asked, true);
    else
        set_solids(v, queue, at, asked, false);
#endif
}

/* Whole packets of a queue; the rest moves to its beginning. */
static void set_packets(tribox_voxels *v, tribox_class kind)
{
    tribox_queue *const queue = &v->sinks.queue[kind];
    unsigned at = 0;
    for (; at + V_LANES <= queue->count; at += V_LANES)
        set_queued(v, kind, at, m_all());
    queue->count -= at;
    for (int n = 0; n < TRIBOX_QUEUED; n++)
        v_write(queue->number[n], v_load(&queue->number[n][at]));
    if (v->window.has_numbers)
        i_write(queue->triangle, i_load(&queue->triangle[at]));
}

/* The last packet of a queue may have fewer triangles than lanes: the others repeat the first, and are left out. */
static void finish_queue(tribox_voxels *v, tribox_class kind)
{
    tribox_queue *const queue = &v->sinks.queue[kind];
    if (queue->count >= V_LANES)
        set_packets(v, kind);
    if (!queue->count)
        return;
    const vmask present = lanes_between(0, queue->count);
    for (int n = 0; n < TRIBOX_QUEUED; n++)
        v_write(queue->number[n], v_select(present, v_load(queue->number[n]), v_splat(queue->number[n][0])));
    set_queued(v, kind, 0, present);
    queue->count = 0;
}

/* For flats, 0 on the axis across the layer. */
TRIBOX_INLINE vnum queued_cells(tribox_class kind, const lane_reach *r, int a)
{
    return kind == TRIBOX_FLATS ? v_select(r->spans[a], r->cells[a], v_splat(0)) : r->cells[a];
}

TRIBOX_INLINE void pack_lanes(const tribox_voxels *v, tribox_queue *queue, tribox_class kind, vmask m, const lane_reach *r)
{
    const unsigned to = queue->count;
    if (v->window.has_numbers)
        i_pack(&queue->triangle[to], m, i_load(r->number));
    for (int n = 0; n < 9; n++)
        v_pack(&queue->number[n][to], m, r->u[n]);
    for (int a = 0; a < 3; a++) {
        v_pack(&queue->number[9 + a][to], m, r->base[a]);
        v_pack(&queue->number[12 + a][to], m, queued_cells(kind, r, a));
    }
}

TRIBOX_INLINE void enqueue(tribox_voxels *v, tribox_class kind, vmask m, const lane_reach *r)
{
    tribox_queue *const queue = &v->sinks.queue[kind];
    if (!m_bits(m))
        return;
    pack_lanes(v, queue, kind, m, r);
    queue->count += m_count(m);
    if (queue->count > TRIBOX_QUEUE - TRIBOX_LANES_MAX)
        set_packets(v, kind);
}

/* The same lanes of a soup that fills no more than this packet: where others would wait, and at once. */
TRIBOX_INLINE void set_lanes(tribox_voxels *v, tribox_class kind, vmask m, const lane_reach *r)
{
    tribox_queue *const queue = &v->sinks.queue[kind];
    const unsigned at = queue->count;
    if (!m_bits(m))
        return;
    if (v->window.has_numbers)
        i_write(&queue->triangle[at], i_load(r->number));
    for (int n = 0; n < 9; n++)
        v_write(&queue->number[n][at], r->u[n]);
    for (int a = 0; a < 3; a++) {
        v_write(&queue->number[9 + a][at], r->base[a]);
        v_write(&queue->number[12 + a][at], queued_cells(kind, r, a));
    }
    set_queued(v, kind, at, m);
}

/* Lines of cells, of the layers asked for alone. */
TRIBOX_INLINE void list_lines(tribox_voxels *v, const lane_reach *r, vmask lines, vnum rows)
{
    const lane_bits bits = bits_at(v, r->base);
    const vint step =
        i_or(i_keep(r->spans[1], i_splat(v->sinks.row_halves)), i_keep(m_not(r->spans[1]), i_splat(v->sinks.layer_halves)));
    const int32_t *const number = listed_numbers(v, r->number);
    vint half = bits.half;
    make_room(v);
    list_bits(v, half, bits.from, i_keep(lines, i_run(i_splat(0), i_cut(r->cells[0]))), number);
    for (int row = 1; row < TRIBOX_LINE_MOST; row++) {
        const vmask longer = m_and(lines, v_gt(rows, v_splat((float)row)));
        if (!m_bits(longer))
            break;
        half = i_add(half, step);
        list(v, longer, half, i_shl(i_splat(1), bits.from), number);
    }
}

/* Of whole numbers. */
TRIBOX_INLINE vmask at_most(vnum a, float most) { return v_gt(v_splat(most + 1), a); }

/*
 * Which cells a packet touches. False if none of its lanes does. z first, then y: whoever asks for some layers alone, or a window,
 * looks at most triangles in vain.
 */
TRIBOX_INLINE bool reach_packet(lane_reach *r, const tribox_voxel_window *w, const lane_window *lanes, const tribox_soup *soup,
                                size_t at)
{
    reach_axis(r, w, &lanes->axis[2], 2, soup->z, at);
    const vmask is_before_end = v_gt(lanes->end_layer, r->base[2]);
    r->inside = m_and(r->inside, m_and(is_before_end, v_gt(v_add(r->base[2], r->cells[2]), lanes->first_layer)));
    if (!m_bits(r->inside))
        return false;
    reach_axis(r, w, &lanes->axis[1], 1, soup->y, at);
    if (!m_bits(r->inside))
        return false;
    reach_axis(r, w, &lanes->axis[0], 0, soup->x, at);
    return true;
}

/* Lanes that span more than one cell on two axes at least, on all three, and few along x. */
typedef struct lane_shapes {
    vmask wide, solid, narrow;
} lane_shapes;

TRIBOX_INLINE lane_shapes shapes_of(const lane_reach *r)
{
    const vmask x = r->spans[0], y = r->spans[1], z = r->spans[2];
    return (lane_shapes){.wide = m_or(m_or(m_and(x, y), m_and(y, z)), m_and(z, x)),
                         .solid = m_and(m_and(x, y), z),
                         .narrow = at_most(r->cells[0], TRIBOX_FLAT_MOST)};
}

/* Lists the lines of few cells among these lanes. Returns the others. */
TRIBOX_INLINE vmask list_short_lines(tribox_voxels *v, const lane_reach *r, vmask inside, lane_shapes shapes,
                                     const lane_window *lanes)
{
    lane_reach line = *r;
    line.base[2] = v_max(r->base[2], lanes->first_layer);
    line.cells[2] = v_sub(v_min(v_add(r->base[2], r->cells[2]), lanes->end_layer), line.base[2]);
    const vnum rows = v_max(r->cells[1], line.cells[2]);
    const vmask lines = m_andnot(m_and(m_and(inside, shapes.narrow), at_most(rows, TRIBOX_LINE_MOST)), shapes.wide);
    if (m_bits(lines))
        list_lines(v, &line, lines, rows);
    return m_andnot(inside, lines);
}

/* Flats, and solids of few cells. */
typedef struct lane_classes {
    vmask flats, solids;
    vnum most; /* cells along y or z */
} lane_classes;

/* Of these lanes. Without edges a shadow has no limits: only the plane has. */
TRIBOX_INLINE lane_classes classes_of(const tribox_voxels *v, const lane_reach *r, vmask left, lane_shapes shapes)
{
    const vmask flat = v->plan.axes & TRIBOX_AXES_EDGES ? m_andnot(shapes.wide, shapes.solid) : m_none();
    const vmask few = m_and(left, shapes.narrow);
    const vnum most = v_max(r->cells[1], r->cells[2]);
    return (lane_classes){.flats = m_and(m_and(few, flat), at_most(most, TRIBOX_FLAT_MOST)),
                          .solids = m_andnot(m_and(m_and(few, shapes.wide), at_most(most, TRIBOX_SOLID_MOST)), flat),
                          .most = most};
}

/* They join their queues, solids by size. */
TRIBOX_INLINE void enqueue_by_class(tribox_voxels *v, const lane_reach *r, lane_classes c)
{
    const vmask small = m_and(c.solids, at_most(c.most, 2)), middle = m_andnot(m_and(c.solids, at_most(c.most, 4)), small);
    enqueue(v, TRIBOX_FLATS, c.flats, r);
    enqueue(v, TRIBOX_SOLIDS_2, small, r);
    enqueue(v, TRIBOX_SOLIDS_4, middle, r);
    enqueue(v, TRIBOX_SOLIDS_8, m_andnot(c.solids, m_or(small, middle)), r);
}

/* These lanes of the packet at triangle `at`. Alone: no others of the soup will join them. */
TRIBOX_INLINE void sort_packet(tribox_voxels *v, const lane_window *lanes, const tribox_soup *soup, size_t at, vmask asked,
                               bool is_alone)
{
    lane_reach r;
    r.number = v->window.number ? v->window.number + at : NULL;
    r.blurred = m_none();
    r.inside = asked;
    if (!reach_packet(&r, &v->window, lanes, soup, at))
        return;
    const vmask inside = m_andnot(m_and(r.inside, is_finite(r.u)), r.blurred), unknown = m_andnot(r.inside, inside);
    if (m_bits(unknown))
        add_each(v, r, m_bits(unknown));
    if (!m_bits(inside))
        return;
    const lane_shapes shapes = shapes_of(&r);
    vmask left = list_short_lines(v, &r, inside, shapes, lanes);
    if (!m_bits(left))
        return;
    /* One lane has nothing to gain: the rows in double are as fast, and fewer. */
    if (V_LANES > 1) {
        const lane_classes c = classes_of(v, &r, left, shapes);
        left = m_andnot(left, m_or(c.flats, c.solids));
        if (is_alone) {
            set_lanes(v, TRIBOX_FLATS, c.flats, &r);
            set_lanes(v, TRIBOX_SOLIDS_8, c.solids, &r);
        } else {
            enqueue_by_class(v, &r, c);
        }
    }
    if (m_bits(left))
        defer(v, r, m_bits(left));
}

/* One of many. */
static void sort_one_of_many(tribox_voxels *v, const lane_window *lanes, const tribox_soup *soup, size_t at, vmask asked)
{
    sort_packet(v, lanes, soup, at, asked, false);
}

#if !defined(TRIBOX_SMALL)
/* In registers: a load of numbers that were stored one by one just now waits for them. */
static void spread_nines(const float (*nine)[9], size_t count, tribox_partial_packet *partial)
{
    vnum number[9];
    for (int n = 0; n < 9; n++)
        number[n] = v_splat(nine[0][n]);
    for (unsigned i = 1; i < count; i++) {
        const vmask lane = lanes_between(i, i + 1);
        for (int n = 0; n < 9; n++)
            number[n] = v_select(lane, v_splat(nine[i][n]), number[n]);
    }
    for (int n = 0; n < 9; n++)
        v_write(partial->number[n], number[n]);
    partial->soup = tribox_soup_of(&partial->number[0][0], TRIBOX_LANES_MAX, count);
}
#endif

/* All of them. A small build has them wait, as it has one instance. */
static void sort_one(tribox_voxels *v, const tribox_soup *soup)
{
    lane_window lanes;
    const vmask all = lanes_between(0, (unsigned)soup->count);
    spread_window(&v->window, &lanes);
#if defined(TRIBOX_SMALL)
    sort_one_of_many(v, &lanes, soup, 0, all);
#else
    sort_packet(v, &lanes, soup, 0, all, true);
#endif
}

/* The last packet ends with the last triangle, unless they are fewer than a packet. */
static void sort_soup(tribox_voxels *v, const tribox_soup *soup)
{
    const unsigned last = soup->count % V_LANES;
    lane_window lanes;
    if (soup->count <= V_LANES) {
        sort_one(v, soup);
        return;
    }
    spread_window(&v->window, &lanes);
    for (size_t at = 0; at + V_LANES <= soup->count; at += V_LANES)
        sort_one_of_many(v, &lanes, soup, at, m_all());
    if (last)
        sort_one_of_many(v, &lanes, soup, soup->count - V_LANES, lanes_between(V_LANES - last, V_LANES));
}

static void finish_cells(tribox_voxels *v)
{
    for (tribox_class kind = TRIBOX_FLATS; V_LANES > 1 && kind < TRIBOX_CLASSES; kind++)
        finish_queue(v, kind);
    write_listed(v);
}

extern const tribox_cells_kernel TRIBOX_SYMBOL(cells);
const tribox_cells_kernel TRIBOX_SYMBOL(cells) = {
    .make_window = make_window,
#if !defined(TRIBOX_SMALL)
    .spread_nines = spread_nines,
#endif
    .sort = sort_soup,
    .finish = finish_cells,
    .write = write_listed,
    .find_tiles = find_tiles,
    .find_ends = find_ends,
    .emit = emit_bricks,
    .take_ids = take_ids,
    .number_cells = number_cells,
};
