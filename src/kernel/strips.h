/*
 * strips.h - the cells of triangles in strips: certain ones are set, open ones wait.
 * After: rows.h, voxels.h. Needs: KERNEL.
 *
 * Layer by layer the projection along x leaves an interval of j. Of a triangle that is flat along x these are its cells: columns. Of
 * others they are rows; they are packed, whatever layers they are of, so that few lanes of a packet are idle.
 *
 * EXACT sets the certain cells and lets the open ones wait. CONSERVATIVE and FAST set every cell that may overlap.
 */
/* Runs of cells, of lanes one after the other: from first to before end, none where end <= first. */
enum { ROWS = 64, ROWS_ROOM = ROWS + TRIBOX_DOUBLES_MAX };
typedef struct runs {
    int32_t first[ROWS_ROOM], end[ROWS_ROOM];
} runs;

/* One triangle; `first` is the first of its layers that is asked, and `end` the one after the last, counted from its own first. */
typedef struct strip_place {
    tribox_voxels *v;
    const tribox_strip *strip;
    const strip_limits *limits;
    unsigned t;
    int64_t first, end;
} strip_place;

/* V_LANES layers: the intervals of j. */
typedef struct layer_packet {
    int32_t first_maybe[V_LANES], end_maybe[V_LANES], first_certain[V_LANES], end_certain[V_LANES];
} layer_packet;

TRIBOX_INLINE vnum from_zero(double first)
{
    static const float count[TRIBOX_DOUBLES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7};
    return v_add(v_splat(first), v_load(count));
}

TRIBOX_INLINE void limit_layers(const strip_place *p, int64_t first, layer_packet *layers)
{
    const vnum wide = v_splat(p->strip->cells[1][p->t]);
    run_limits run = no_limits();
    narrow_by_edges(&run, p->limits, p->t, 0, from_zero((double)first));
    write_ends(layers->first_maybe, layers->end_maybe, &run.maybe, wide);
    write_ends(layers->first_certain, layers->end_certain, &run.certain, wide);
}

static int64_t base_of(const strip_place *p, int a) { return (int64_t)p->strip->base[a][p->t]; }

static void take_triangle(const strip_place *p, float u[9])
{
    for (int n = 0; n < 9; n++)
        u[n] = p->strip->u[n][p->t];
}

/* ---- columns ---- */

static void wait_for_column(const strip_place *p, int64_t first, int64_t end, int64_t layer)
{
    float u[9];
    take_triangle(p, u);
    for (int64_t j = first; j < end; j++)
        tribox_voxels_wait(p->v, u, base_of(p, 0), base_of(p, 0), base_of(p, 1) + j, base_of(p, 2) + layer);
}

TRIBOX_INLINE void set_columns(const strip_place *p, bool has_certain)
{
    const size_t row = p->v->row_words, layer = row * p->v->grid->size[1];
    const uint64_t bit = UINT64_C(1) << p->strip->bit[p->t];
    uint64_t *const word = p->v->occupied + p->strip->word[p->t];
    size_t set = 0;
    for (int64_t k = p->first; k < p->end; k += V_LANES) {
        layer_packet layers;
        limit_layers(p, k, &layers);
        for (int n = 0; n < V_LANES && k + n < p->end; n++) {
            const int64_t first = layers.first_maybe[n], end = layers.end_maybe[n];
            int64_t certain = has_certain ? layers.first_certain[n] : first,
                    certain_end = has_certain ? layers.end_certain[n] : end;
            if (certain < certain_end)
                set += tribox_set_column(word + (k + n) * (int64_t)layer + certain * (int64_t)row, row, certain_end - certain, bit);
            else
                certain = certain_end = end;
            if (has_certain && (first < certain || certain_end < end)) {
                wait_for_column(p, first, certain, k + n);
                wait_for_column(p, certain_end, end, k + n);
            }
        }
    }
    p->v->counts.overlapping += set;
}

/* ---- rows ---- */

typedef struct row_list {
    unsigned count;
    uint64_t open; /* rows that the projection along x leaves open */
    double j[ROWS_ROOM], k[ROWS_ROOM];
    int32_t word[ROWS_ROOM]; /* of the first cell of the triangle's range */
    runs maybe, certain;
} row_list;

/* `more` rows from (j, k) on, along y or z. */
TRIBOX_INLINE void list_run(row_list *rows, int64_t j, int64_t k, unsigned more, bool is_along_z)
{
    for (unsigned n = 0; n < more; n += V_LANES) {
        v_write(&rows->j[rows->count + n], is_along_z ? v_splat((double)j) : from_zero((double)(j + n)));
        v_write(&rows->k[rows->count + n], is_along_z ? from_zero((double)(k + n)) : v_splat((double)k));
    }
    rows->count += more;
}

/* Where a walk over the rows of a triangle stands: before row j of a layer whose interval ends at end_j. */
typedef struct row_cursor {
    int64_t layer, j, end_j;
    layer_packet layers;
} row_cursor;

/* To the next layer. Returns whether there is one. */
TRIBOX_INLINE bool next_layer(const strip_place *p, row_cursor *at)
{
    if (++at->layer >= p->end)
        return false;
    const int64_t n = (at->layer - p->first) % V_LANES;
    if (n == 0)
        limit_layers(p, at->layer, &at->layers);
    at->j = at->layers.first_maybe[n];
    at->end_j = at->layers.end_maybe[n];
    return true;
}

/* Which of `more` rows from at->j on the projection along x leaves open, as bits. */
TRIBOX_INLINE uint64_t open_rows(const strip_place *p, const row_cursor *at, unsigned more)
{
    const int64_t n = (at->layer - p->first) % V_LANES;
    const int64_t certain = at->layers.first_certain[n], end = at->layers.end_certain[n];
    uint64_t open = 0;
    if (at->j < certain || at->j + more > end)
        for (unsigned i = 0; i < more; i++)
            open |= (uint64_t)(at->j + i < certain || at->j + i >= end) << i;
    return open;
}

/* The next rows of a solid triangle: those that the projection along x leaves. Returns whether there are any. */
TRIBOX_INLINE bool list_solid(const strip_place *p, row_cursor *at, row_list *rows, bool has_certain)
{
    rows->count = 0;
    rows->open = 0;
    do {
        while (at->j < at->end_j) {
            const unsigned more = (unsigned)tribox_least(at->end_j - at->j, ROWS - rows->count);
            if (has_certain)
                rows->open |= open_rows(p, at, more) << rows->count;
            list_run(rows, at->j, at->layer, more, false);
            at->j += more;
            if (rows->count == ROWS)
                return true;
        }
    } while (next_layer(p, at));
    return rows->count;
}

/* The next rows of a flat one. */
TRIBOX_INLINE bool list_flat(const strip_place *p, row_cursor *at, row_list *rows, tribox_shape shape)
{
    const bool is_along_z = shape == TRIBOX_FLAT_Y;
    const int64_t left = is_along_z ? p->end - at->layer : at->end_j - at->j;
    rows->count = 0;
    rows->open = 0;
    if (left <= 0)
        return false;
    list_run(rows, at->j, at->layer, (unsigned)tribox_least(left, ROWS), is_along_z);
    *(is_along_z ? &at->layer : &at->j) += ROWS;
    return true;
}

/* The cells of the listed rows, and their words. */
TRIBOX_INLINE void limit_rows(const strip_place *p, row_list *rows, tribox_shape shape, bool has_certain)
{
    const unsigned t = p->t;
    const double row_words = (double)p->v->row_words, layer_words = row_words * p->v->grid->size[1];
    const vnum cells = v_splat(p->strip->cells[0][t]), word = v_splat(p->strip->word[t]);
    for (unsigned n = rows->count; n % V_LANES; n++) {
        rows->j[n] = rows->j[rows->count - 1];
        rows->k[n] = rows->k[rows->count - 1];
    }
    for (unsigned n = 0; n < rows->count; n += V_LANES) {
        const vnum j = v_read(&rows->j[n]), k = v_read(&rows->k[n]);
        run_limits run = no_limits();
        if (shape != TRIBOX_FLAT_Z)
            narrow_by_edges(&run, p->limits, t, 1, k);
        if (shape != TRIBOX_FLAT_Y)
            narrow_by_edges(&run, p->limits, t, 2, j);
        if (shape == TRIBOX_SOLID)
            narrow_by_plane(&run, &p->limits->plane, t, j, k);
        v_write_int(&rows->word[n], v_fma(k, v_splat(layer_words), v_fma(j, v_splat(row_words), word)));
        write_ends(&rows->maybe.first[n], &rows->maybe.end[n], &run.maybe, cells);
        if (has_certain)
            write_ends(&rows->certain.first[n], &rows->certain.end[n], &run.certain, cells);
    }
    for (uint64_t open = rows->open; open; open &= open - 1)
        rows->certain.end[tribox_lowest_bit(open)] = 0;
}

/* The bits below bit n, which is at most 63. */
static inline uint64_t bits_below(int n) { return (UINT64_C(1) << n) - 1; }

static inline uint64_t run_bits(const runs *r, unsigned n) { return bits_below(r->end[n]) & ~bits_below(r->first[n]); }

/* Sets these cells of the listed rows, each of which lies in one word. Eight words are loaded before one is stored (cell_bits.h). */
static size_t set_narrow_rows(uint64_t *occupied, const row_list *rows, const runs *cells, int bit)
{
    size_t set = 0;
    unsigned n = 0;
    for (; n + 8 <= rows->count; n += 8) {
        uint64_t before[8], bits[8];
        for (unsigned i = 0; i < 8; i++) {
            before[i] = occupied[rows->word[n + i]];
            bits[i] = run_bits(cells, n + i) << bit;
        }
        for (unsigned i = 0; i < 8; i++) {
            occupied[rows->word[n + i]] = before[i] | bits[i];
            set += tribox_count_bits(bits[i] & ~before[i]);
        }
    }
    for (; n < rows->count; n++)
        set += tribox_set_bits(&occupied[rows->word[n]], run_bits(cells, n) << bit);
    return set;
}

/* The same for rows of any length. */
static size_t set_wide_rows(uint64_t *occupied, const row_list *rows, const runs *cells, int bit)
{
    size_t set = 0;
    for (unsigned n = 0; n < rows->count; n++)
        if (cells->first[n] < cells->end[n])
            set += tribox_set_cells(occupied + rows->word[n], bit + cells->first[n], bit + cells->end[n] - 1);
    return set;
}

/* Cells of the listed rows that may overlap but do not certainly do so wait. */
static void wait_for_rows(const strip_place *p, const row_list *rows)
{
    const runs *const maybe = &rows->maybe, *const certain = &rows->certain;
    for (unsigned n = 0; n < rows->count; n++) {
        if (maybe->first[n] >= maybe->end[n] || (maybe->first[n] == certain->first[n] && maybe->end[n] == certain->end[n]))
            continue;
        const int64_t base = base_of(p, 0), j = base_of(p, 1) + (int64_t)rows->j[n], k = base_of(p, 2) + (int64_t)rows->k[n];
        const int64_t first = base + maybe->first[n], end = base + maybe->end[n];
        const bool is_any = certain->first[n] < certain->end[n];
        float u[9];
        take_triangle(p, u);
        tribox_voxels_wait(p->v, u, first, (is_any ? base + certain->first[n] : end) - 1, j, k);
        tribox_voxels_wait(p->v, u, is_any ? base + certain->end[n] : end, end - 1, j, k);
    }
}

TRIBOX_INLINE void set_rows(const strip_place *p, tribox_shape shape, bool has_certain)
{
    const int bit = p->strip->bit[p->t];
    const bool is_narrow = bit + p->strip->cells[0][p->t] < 64;
    row_cursor at = {.layer = p->first, .j = 0, .end_j = (int64_t)p->strip->cells[1][p->t]};
    row_list rows;
    if (shape == TRIBOX_SOLID) {
        at.end_j = 0;
        at.layer--;
    } else if (p->first >= p->end) {
        return;
    }
    while (shape == TRIBOX_SOLID ? list_solid(p, &at, &rows, has_certain) : list_flat(p, &at, &rows, shape)) {
        limit_rows(p, &rows, shape, has_certain);
        p->v->counts.overlapping +=
            (is_narrow ? set_narrow_rows : set_wide_rows)(p->v->occupied, &rows, has_certain ? &rows.certain : &rows.maybe, bit);
        if (has_certain)
            wait_for_rows(p, &rows);
    }
}

TRIBOX_INLINE void set_strip_by(tribox_voxels *v, tribox_shape shape, bool has_certain)
{
    const tribox_strip *const strip = &v->strip[shape];
    strip_limits limits;
    prepare(strip, &v->lattice, v->plan.axes, v->plan.accuracy == TRIBOX_FAST ? 0 : 1, &limits, shape);
    for (unsigned t = 0; t < strip->count; t++) {
        const int64_t base = (int64_t)strip->base[2][t], layers = (int64_t)strip->cells[2][t];
        const strip_place p = {
            v, strip, &limits, t, tribox_greatest(v->first_layer - base, 0), tribox_least(layers, v->end_layer - base)};
        if (shape == TRIBOX_FLAT_X)
            set_columns(&p, has_certain);
        else
            set_rows(&p, shape, has_certain);
    }
}

TRIBOX_INLINE void set_strip(tribox_voxels *v, tribox_shape shape)
{
    if (v->plan.accuracy == TRIBOX_EXACT)
        set_strip_by(v, shape, true);
    else
        set_strip_by(v, shape, false);
}

static void set_solid(tribox_voxels *v) { set_strip(v, TRIBOX_SOLID); }
static void set_flat_x(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_X); }
static void set_flat_y(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_Y); }
static void set_flat_z(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_Z); }

extern const tribox_grid_kernel TRIBOX_SYMBOL(grid);
const tribox_grid_kernel TRIBOX_SYMBOL(grid) = {
    .set_strip = {set_solid, set_flat_x, set_flat_y, set_flat_z},
};
