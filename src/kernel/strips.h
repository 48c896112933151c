/*
 * strips.h - the cells of triangles in strips, row after row: certain ones are set, open ones wait.
 * After: rows.h, voxels.h. Needs: KERNEL.
 */
/* The rows of one triangle: layers of `wide` rows, cells along x counted from base, whose bit is `bit` of a row's `word`. */
typedef struct row_range {
    int64_t base, first_j, first_k, wide;
    ptrdiff_t word, skip; /* skip: from the end of the last row of a layer to the first of the next */
    int bit;
    bool is_narrow; /* no row has cells in two words */
} row_range;

/* Where a walk over rows stands; `word` is the one of the first cell. */
typedef struct row_place {
    int64_t j, k;
    uint64_t *word;
} row_place;

/* The place of row j of layer k, both counted from the first. */
static row_place place_of(const tribox_voxels *v, const row_range *r, int64_t j, int64_t k)
{
    return (row_place){r->first_j + j, r->first_k + k,
                       v->occupied + r->word + (k * (int64_t)v->grid->size[1] + j) * (int64_t)v->row_words};
}

static void next_row(row_place *at, const tribox_voxels *v, const row_range *r)
{
    at->word += v->row_words;
    if (++at->j == r->first_j + r->wide) {
        at->j = r->first_j;
        at->k++;
        at->word += r->skip;
    }
}

/* Whether row n has cells that may overlap but do not certainly do so. */
static bool is_row_open(const tribox_row_cells *cells, unsigned n)
{
    return cells->first_maybe[n] < cells->end_maybe[n] &&
           (cells->first_maybe[n] != cells->first_certain[n] || cells->end_maybe[n] != cells->end_certain[n]);
}

/* The open cells of these rows are tested by their own boxes. */
static void add_open_rows(tribox_voxels *v, const tribox_strip *strip, unsigned t, const row_range *r, row_place at, unsigned rows,
                          const tribox_row_cells *cells)
{
    float u[9];
    for (int n = 0; n < 9; n++)
        u[n] = strip->u[n][t];
    for (unsigned n = 0; n < rows; n++, next_row(&at, v, r)) {
        if (!is_row_open(cells, n))
            continue;
        const bool has_certain = cells->first_certain[n] < cells->end_certain[n];
        const int64_t first = r->base + cells->first_maybe[n], end = r->base + cells->end_maybe[n];
        const int64_t certain = has_certain ? r->base + cells->first_certain[n] : end,
                      certain_end = has_certain ? r->base + cells->end_certain[n] : end;
        tribox_voxels_wait(v, u, first, certain - 1, at.j, at.k);
        tribox_voxels_wait(v, u, certain_end, end - 1, at.j, at.k);
    }
}

/* The bits below bit n, which is at most 63. */
static uint64_t bits_below(int n) { return (UINT64_C(1) << n) - 1; }

/*
 * Sets the certain cells of rows that lie in one word each, without a branch on what they hold. Returns whether any cell is open.
 */
static bool set_narrow_rows(tribox_voxels *v, const row_range *r, row_place at, unsigned rows, const tribox_row_cells *cells)
{
    uint64_t open = 0;
    size_t set = 0;
    for (unsigned n = 0; n < rows; n++, next_row(&at, v, r)) {
        const uint64_t maybe = bits_below(cells->end_maybe[n]) & ~bits_below(cells->first_maybe[n]);
        const uint64_t certain = bits_below(cells->end_certain[n]) & ~bits_below(cells->first_certain[n]);
        const uint64_t before = *at.word;
        *at.word = before | certain << r->bit;
        set += tribox_count_bits(certain & ~(before >> r->bit));
        open |= maybe & ~certain;
    }
    v->counts.overlapping += set;
    return open;
}

/* The same for rows of any length. */
static bool set_wide_rows(tribox_voxels *v, const row_range *r, row_place at, unsigned rows, const tribox_row_cells *cells)
{
    bool is_open = false;
    size_t set = 0;
    for (unsigned n = 0; n < rows; n++, next_row(&at, v, r)) {
        if (cells->first_certain[n] < cells->end_certain[n])
            set += tribox_set_cells(at.word, r->bit + cells->first_certain[n], r->bit + cells->end_certain[n] - 1);
        is_open |= is_row_open(cells, n);
    }
    v->counts.overlapping += set;
    return is_open;
}

TRIBOX_INLINE void set_rows(tribox_voxels *v, const tribox_strip *strip, unsigned t, tribox_shape shape,
                            const tribox_limits *limits)
{
    const row_range r = {
        .base = (int64_t)strip->base[0][t],
        .first_j = (int64_t)strip->base[1][t],
        .first_k = (int64_t)strip->base[2][t],
        .wide = (int64_t)strip->cells[1][t],
        .word = strip->word[t],
        .skip = ((ptrdiff_t)v->grid->size[1] - (ptrdiff_t)strip->cells[1][t]) * (ptrdiff_t)v->row_words,
        .bit = strip->bit[t],
        .is_narrow = strip->bit[t] + strip->cells[0][t] < 64,
    };
    const int64_t first_layer = tribox_greatest(v->first_layer - r.first_k, 0);
    const int64_t end = tribox_least((int64_t)strip->cells[2][t], v->end_layer - r.first_k) * r.wide;
    row_place at = place_of(v, &r, 0, first_layer);
    for (int64_t row = first_layer * r.wide; row < end; row += 64) {
        const unsigned rows = (unsigned)tribox_least(end - row, 64);
        tribox_row_cells cells;
        walk_rows(limits, t, (double)row, rows, &cells, shape);
        if (v->plan.accuracy == TRIBOX_CONSERVATIVE) { /* sets every cell that may overlap, and tests none */
            memcpy(cells.first_certain, cells.first_maybe, sizeof cells.first_certain);
            memcpy(cells.end_certain, cells.end_maybe, sizeof cells.end_certain);
        }
        if ((r.is_narrow ? set_narrow_rows : set_wide_rows)(v, &r, at, rows, &cells))
            add_open_rows(v, strip, t, &r, at, rows, &cells);
        if (row + 64 < end)
            at = place_of(v, &r, (row + 64) % r.wide, (row + 64) / r.wide);
    }
}

TRIBOX_INLINE void set_strip(tribox_voxels *v, tribox_shape shape)
{
    const tribox_strip *const strip = &v->strip[shape];
    tribox_limits limits;
    prepare(strip, &v->lattice, v->plan.axes, v->plan.accuracy == TRIBOX_FAST ? 0 : 1, &limits, shape);
    for (unsigned t = 0; t < strip->count; t++)
        set_rows(v, strip, t, shape, &limits);
}

static void set_solid(tribox_voxels *v) { set_strip(v, TRIBOX_SOLID); }
static void set_flat_x(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_X); }
static void set_flat_y(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_Y); }
static void set_flat_z(tribox_voxels *v) { set_strip(v, TRIBOX_FLAT_Z); }

extern const tribox_grid_kernel TRIBOX_SYMBOL(grid);
const tribox_grid_kernel TRIBOX_SYMBOL(grid) = {
    .set_strip = {set_solid, set_flat_x, set_flat_y, set_flat_z},
};
