/*
 * packed_rows.h - the cells of a triangle, row by row: rows are packed whatever layers they are of, so that packets are full.
 * After: columns.h.
 */
enum { ROWS = 64, ROWS_ROOM = ROWS + TRIBOX_DOUBLES_MAX };

/* The cells of each row, counted from the triangle's first: from first to before end, none where end <= first. */
typedef struct row_cells {
    int32_t first[ROWS_ROOM], end[ROWS_ROOM];
} row_cells;

typedef struct row_list {
    unsigned count;
    uint64_t undecided; /* rows that the projection along x leaves undecided */
    double j[ROWS_ROOM], k[ROWS_ROOM];
    int32_t word[ROWS_ROOM]; /* of the triangle's first cell on the axis of x */
    row_cells maybe, certain;
} row_list;

/* Where a walk over the rows of a triangle stands: before row (j, k) of a run of rows along y, or along z if it is flat along y. */
typedef struct row_cursor {
    int64_t j, k, left;
    layer_packet layers;
} row_cursor;

/* The next rows of the run. */
TRIBOX_INLINE void list_run(row_list *rows, row_cursor *at, unsigned more, bool is_along_z)
{
    for (unsigned n = 0; n < more; n += V_LANES) {
        v_write(&rows->j[rows->count + n], is_along_z ? v_splat((double)at->j) : layers_from(at->j + n));
        v_write(&rows->k[rows->count + n], is_along_z ? layers_from(at->k + n) : v_splat((double)at->k));
    }
    rows->count += more;
    *(is_along_z ? &at->k : &at->j) += more;
    at->left -= more;
}

/* To the rows of the next layer of a solid triangle. Returns whether there is one. */
TRIBOX_INLINE bool next_layer(const strip_place *p, row_cursor *at)
{
    if (++at->k >= p->end)
        return false;
    const int64_t n = (at->k - p->first) % V_LANES;
    if (n == 0)
        limit_layers(p, at->k, &at->layers);
    at->j = at->layers.first_maybe[n];
    at->left = at->layers.end_maybe[n] - at->j;
    return true;
}

/* Which of the next rows of the layer the projection along x leaves undecided, as bits. */
TRIBOX_INLINE uint64_t undecided_rows(const strip_place *p, const row_cursor *at, unsigned more)
{
    const int64_t n = (at->k - p->first) % V_LANES;
    const int64_t certain = at->layers.first_certain[n], end = at->layers.end_certain[n];
    uint64_t undecided = 0;
    if (at->j < certain || at->j + more > end)
        for (unsigned i = 0; i < more; i++)
            undecided |= (uint64_t)(at->j + i < certain || at->j + i >= end) << i;
    return undecided;
}

/* The next rows of a triangle; of a solid one those that the projection along x leaves. Returns whether there are any. */
TRIBOX_INLINE bool list_rows(const strip_place *p, row_cursor *at, row_list *rows, tribox_shape shape, bool has_certain)
{
    rows->count = 0;
    rows->undecided = 0;
    while (rows->count < ROWS) {
        if (at->left > 0) {
            const unsigned added = (unsigned)tribox_least(at->left, ROWS - rows->count);
            if (shape == TRIBOX_SOLID && has_certain)
                rows->undecided |= undecided_rows(p, at, added) << rows->count;
            list_run(rows, at, added, shape == TRIBOX_FLAT_Y);
        } else if (shape != TRIBOX_SOLID || !next_layer(p, at)) {
            break;
        }
    }
    return rows->count;
}

TRIBOX_INLINE row_cursor first_rows(const strip_place *p, tribox_shape shape)
{
    const int64_t layers = tribox_greatest(p->end - p->first, 0);
    switch (shape) {
    case TRIBOX_FLAT_Y:
        return (row_cursor){.k = p->first, .left = layers};
    case TRIBOX_FLAT_Z:
        return (row_cursor){.k = p->first, .left = layers * (int64_t)p->strip->cells[1][p->t]};
    default:
        return (row_cursor){.k = p->first - 1};
    }
}

/* What limits leave of rows (j, k). */
TRIBOX_INLINE lane_run limits_of_rows(const strip_place *p, vnum cells, vnum j, vnum k, tribox_shape shape, bool has_certain)
{
    lane_run run = whole_run(cells);
    if (shape != TRIBOX_FLAT_Z)
        narrow_by_shadow(&run, p->limits, p->t, 1, k, has_certain);
    if (shape != TRIBOX_FLAT_Y)
        narrow_by_shadow(&run, p->limits, p->t, 2, j, has_certain);
    if (shape == TRIBOX_SOLID)
        narrow_by_plane(&run, &p->limits->plane, p->t, j, k);
    return run;
}

/* A packet of rows: their words, which come into the cache meanwhile, and their cells. */
TRIBOX_INLINE void limit_rows(const strip_place *p, row_list *rows, unsigned at, tribox_shape shape, bool has_certain)
{
    const unsigned t = p->t;
    const double row_words = (double)p->v->sinks.row_words, layer_words = row_words * p->v->window.size[1];
    const vnum j = v_read(&rows->j[at]), k = v_read(&rows->k[at]), cells = v_splat(p->strip->cells[0][t]);
    const lane_run run = limits_of_rows(p, cells, j, k, shape, has_certain);
    write_ends(&rows->maybe.first[at], &rows->maybe.end[at], run.first_maybe, run.end_maybe, cells);
    if (has_certain)
        write_ends(&rows->certain.first[at], &rows->certain.end[at], run.first_certain, run.end_certain, cells);
    const vnum layer = v_sub(k, v_splat((double)p->first)), word = v_splat((double)p->strip->word[t]);
    v_write_int(&rows->word[at], v_fma(layer, v_splat(layer_words), v_fma(j, v_splat(row_words), word)));
    if (p->v->sinks.is_far)
        for (unsigned n = at; n < at + V_LANES; n++) { /* the word after the last may be 2^31 */
            const uint32_t first = (uint32_t)(p->strip->bit[t] + rows->maybe.first[n]) / 64;
            tribox_will_write(p->v->sinks.occupied + ((uint32_t)rows->word[n] + first));
        }
}

/* Lanes after the last row repeat it. */
TRIBOX_INLINE void limit_all_rows(const strip_place *p, row_list *rows, tribox_shape shape, bool has_certain)
{
    for (unsigned n = rows->count; n % V_LANES; n++) {
        rows->j[n] = rows->j[rows->count - 1];
        rows->k[n] = rows->k[rows->count - 1];
    }
    for (unsigned at = 0; at < rows->count; at += V_LANES)
        limit_rows(p, rows, at, shape, has_certain);
    for (uint64_t undecided = rows->undecided; undecided; undecided &= undecided - 1)
        rows->certain.end[tribox_lowest_bit(undecided)] = 0;
}

/* The bits below bit n, which is at most 63. */
static inline uint64_t bits_below(int n) { return (UINT64_C(1) << n) - 1; }

static inline uint64_t cell_bits(const row_cells *cells, unsigned n)
{
    return bits_below(cells->end[n]) & ~bits_below(cells->first[n]);
}

/* Rows that lie in one word each: eight are loaded before one is stored (cell_bits.h). Returns how many cells were not set. */
static size_t set_narrow_rows(uint64_t *occupied, const row_list *rows, const row_cells *cells, int bit)
{
    size_t set = 0;
    unsigned n = 0;
    for (; n + 8 <= rows->count; n += 8) {
        uint64_t before[8], bits[8];
        for (unsigned i = 0; i < 8; i++) {
            before[i] = occupied[rows->word[n + i]];
            bits[i] = cell_bits(cells, n + i) << bit;
        }
        for (unsigned i = 0; i < 8; i++) {
            occupied[rows->word[n + i]] = before[i] | bits[i];
            set += tribox_count_bits(bits[i] & ~before[i]);
        }
    }
    for (; n < rows->count; n++)
        set += tribox_set_bits(&occupied[rows->word[n]], cell_bits(cells, n) << bit);
    return set;
}

/* The same for rows of any length. */
static size_t set_wide_rows(uint64_t *occupied, const row_list *rows, const row_cells *cells, int bit)
{
    size_t set = 0;
    for (unsigned n = 0; n < rows->count; n++)
        if (cells->first[n] < cells->end[n])
            set += tribox_set_cells(occupied + rows->word[n], bit + cells->first[n], bit + cells->end[n] - 1);
    return set;
}

/* The ids of rows that lie in one word each, before they are set. */
TRIBOX_NOINLINE void lower_narrow_rows(const strip_place *p, const row_list *rows, const row_cells *cells)
{
    const tribox_cell_ids *const ids = &p->v->sinks.ids;
    const uint64_t *const occupied = p->v->sinks.occupied;
    const int bit = p->strip->bit[p->t];
    const uint32_t id = tribox_voxels_id(p->v, p->strip->number[p->t]);
    for (unsigned n = 0; n < rows->count; n++) {
        const int from = bit + cells->first[n], count = cells->end[n] - cells->first[n];
        if (count > 0)
            tribox_lower_run(ids, tribox_ids_of_word(ids, (uint32_t)rows->word[n]) + from, occupied[rows->word[n]] >> from, count,
                             id);
    }
}

/* Their ids, before they are set. */
TRIBOX_NOINLINE void lower_wide_rows(const strip_place *p, const row_list *rows, const row_cells *cells)
{
    const int bit = p->strip->bit[p->t];
    const uint32_t id = tribox_voxels_id(p->v, p->strip->number[p->t]);
    for (unsigned n = 0; n < rows->count; n++)
        if (cells->first[n] < cells->end[n])
            tribox_lower_row(&p->v->sinks.ids, p->v->sinks.occupied, (size_t)rows->word[n], bit + cells->first[n],
                             bit + cells->end[n] - 1, id);
}

/* Lists them with the triangle. */
TRIBOX_NOINLINE void pair_rows(const strip_place *p, const row_list *rows, const row_cells *cells)
{
    const int bit = p->strip->bit[p->t];
    for (unsigned n = 0; n < rows->count; n++)
        tribox_voxels_pair_row(p->v, (size_t)rows->word[n], bit + cells->first[n], bit + cells->end[n] - 1, p->strip->number[p->t]);
}

static size_t set_listed_rows(uint64_t *occupied, const row_list *rows, const row_cells *cells, int bit, bool is_narrow)
{
    return is_narrow ? set_narrow_rows(occupied, rows, cells, bit) : set_wide_rows(occupied, rows, cells, bit);
}

/* Whether cells may be undecided: told without a branch. */
static bool may_be_undecided(const row_list *rows)
{
    int32_t differ = 0;
    for (unsigned n = 0; n < rows->count; n++)
        differ |= (rows->maybe.first[n] ^ rows->certain.first[n]) | (rows->maybe.end[n] ^ rows->certain.end[n]);
    return differ;
}

/* Cells that may overlap but do not certainly do so wait. */
TRIBOX_NOINLINE void wait_for_rows(const strip_place *p, const row_list *rows)
{
    for (unsigned n = 0; n < rows->count; n++) {
        const int64_t first = rows->maybe.first[n], end = rows->maybe.end[n], j = (int64_t)rows->j[n], k = (int64_t)rows->k[n];
        const int64_t certain = rows->certain.first[n], certain_end = rows->certain.end[n];
        if (first >= end || (first == certain && end == certain_end))
            continue;
        if (certain < certain_end) {
            wait_for_row(p, first, certain, j, k);
            wait_for_row(p, certain_end, end, j, k);
        } else {
            wait_for_row(p, first, end, j, k);
        }
    }
}
