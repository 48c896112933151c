/*
 * voxelize.c - a soup into the cells of a grid.
 *
 * A word of triangles at a time: the kernel tells which cells their bounding boxes touch. A triangle whose box spans cells on one
 * axis at most overlaps them all, as it is connected. Of the others the kernel limits row after row; the cells between the limits
 * that rounding leaves open are settled by their own boxes, unless they are set anyway.
 */
#include <string.h>

#include "bits.h"
#include "environment.h"
#include "finite.h"
#include "grid.h"
#include "settle.h"
#include "soup.h"

/* Triangles of one shape that wait for their rows. */
typedef struct crowd {
    tribox_strip strip;
    int32_t word[TRIBOX_STRIP], bit[TRIBOX_STRIP]; /* of their first cells, as in tribox_touched */
} crowd;

/* One call. */
typedef struct voxels {
    const tribox_grid *grid;
    tribox_plan plan;
    tribox_lattice lattice;
    int64_t first_layer, end_layer;
    size_t row_words;
    uint64_t *occupied; /* of the first layer */
    tribox_report counts;
    crowd crowds[TRIBOX_SHAPES];
    /* cells that are open */
    tribox_batch batch;
    unsigned open;
    struct {
        uint64_t *word, bit;
    } cell[TRIBOX_BATCH];
} voxels;

static int64_t least_of(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t most_of(int64_t a, int64_t b) { return a > b ? a : b; }

/* Returns how many of the bits were not set before. */
static size_t set_bits(uint64_t *word, uint64_t bits)
{
    const uint64_t before = *word;
    *word = before | bits;
    return tribox_count_bits(bits & ~before);
}

/* Cells first to last of a row, a word at a time. Returns how many were not set before. */
static size_t set_cells(uint64_t *row, int64_t first, int64_t last)
{
    const uint64_t full = ~UINT64_C(0), from = full << first % 64, to = full >> (63 - last % 64);
    uint64_t *word = row + first / 64, *const end = row + last / 64;
    if (word == end)
        return set_bits(word, from & to);
    size_t set = set_bits(word, from);
    while (++word < end)
        if (*word != full)
            set += set_bits(word, full);
    return set + set_bits(word, to);
}

static uint64_t *row_words_at(const voxels *v, int64_t j, int64_t k)
{
    return v->occupied + ((size_t)(k - v->first_layer) * v->grid->size[1] + (size_t)j) * v->row_words;
}

static void settle_open_cells(voxels *v)
{
    if (!v->open)
        return;
    v->counts.undecided += v->open;
    for (uint64_t left = tribox_settle_batch(&v->batch, v->open, ~UINT64_C(0), &v->plan); left; left &= left - 1) {
        const unsigned i = tribox_lowest_bit(left);
        v->counts.overlapping += set_bits(v->cell[i].word, v->cell[i].bit);
    }
    v->open = 0;
}

/* Cells first to last of row (j, k), of which only their own boxes can tell; those that are set need no answer. */
static void add_open_cells(voxels *v, const float u[9], uint64_t *row, int64_t first, int64_t last, int64_t j, int64_t k)
{
    for (int64_t i = first; i <= last; i++) {
        uint64_t *const word = row + i / 64;
        const uint64_t bit = UINT64_C(1) << i % 64;
        if (*word & bit)
            continue;
        const int64_t at[3] = {i, j, k};
        const unsigned to = v->open++;
        v->cell[to].word = word;
        v->cell[to].bit = bit;
        for (int n = 0; n < 9; n++)
            v->batch.number[n][to] = u[n];
        for (int a = 0; a < 3; a++) {
            v->batch.number[9 + a][to] = tribox_grid_plane(v->grid, a, (uint64_t)at[a]);
            v->batch.number[12 + a][to] = tribox_grid_plane(v->grid, a, (uint64_t)at[a] + 1);
        }
        if (v->open == TRIBOX_BATCH)
            settle_open_cells(v);
    }
}

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
static row_place place_of(const voxels *v, const row_range *r, int64_t j, int64_t k)
{
    return (row_place){r->first_j + j, r->first_k + k,
                       v->occupied + r->word + (k * (int64_t)v->grid->size[1] + j) * (int64_t)v->row_words};
}

static void next_row(row_place *at, const voxels *v, const row_range *r)
{
    at->word += v->row_words;
    if (++at->j == r->first_j + r->wide) {
        at->j = r->first_j;
        at->k++;
        at->word += r->skip;
    }
}

/* Whether row n has cells that may overlap, and not surely do. */
static bool is_row_open(const tribox_row_cells *cells, unsigned n)
{
    return cells->first_maybe[n] < cells->end_maybe[n] &&
           (cells->first_maybe[n] != cells->first_sure[n] || cells->end_maybe[n] != cells->end_sure[n]);
}

/* These cells are asked by their own boxes. */
static void add_open_rows(voxels *v, const tribox_strip *strip, unsigned t, const row_range *r, row_place at, unsigned rows,
                          const tribox_row_cells *cells)
{
    float u[9];
    for (int n = 0; n < 9; n++)
        u[n] = strip->u[n][t];
    for (unsigned n = 0; n < rows; n++, next_row(&at, v, r)) {
        if (!is_row_open(cells, n))
            continue;
        const bool has_sure = cells->first_sure[n] < cells->end_sure[n];
        const int64_t first = r->base + cells->first_maybe[n], end = r->base + cells->end_maybe[n];
        const int64_t sure = has_sure ? r->base + cells->first_sure[n] : end,
                      sure_end = has_sure ? r->base + cells->end_sure[n] : end;
        uint64_t *const row = at.word - r->base / 64;
        add_open_cells(v, u, row, first, sure - 1, at.j, at.k);
        add_open_cells(v, u, row, sure_end, end - 1, at.j, at.k);
    }
}

/* The bits below bit n, which is at most 63. */
static uint64_t bits_below(int n) { return (UINT64_C(1) << n) - 1; }

/* Rows whose cells all lie in one word, without a branch on what they hold. Whether any is open. */
static bool set_narrow_rows(voxels *v, const row_range *r, row_place at, unsigned rows, const tribox_row_cells *cells)
{
    uint64_t open = 0;
    size_t set = 0;
    for (unsigned n = 0; n < rows; n++, next_row(&at, v, r)) {
        const uint64_t maybe = bits_below(cells->end_maybe[n]) & ~bits_below(cells->first_maybe[n]);
        const uint64_t sure = bits_below(cells->end_sure[n]) & ~bits_below(cells->first_sure[n]);
        const uint64_t before = *at.word;
        *at.word = before | sure << r->bit;
        set += tribox_count_bits(sure & ~(before >> r->bit));
        open |= maybe & ~sure;
    }
    v->counts.overlapping += set;
    return open;
}

static bool set_wide_rows(voxels *v, const row_range *r, row_place at, unsigned rows, const tribox_row_cells *cells)
{
    bool is_open = false;
    size_t set = 0;
    for (unsigned n = 0; n < rows; n++, next_row(&at, v, r)) {
        if (cells->first_sure[n] < cells->end_sure[n])
            set += set_cells(at.word, r->bit + cells->first_sure[n], r->bit + cells->end_sure[n] - 1);
        is_open |= is_row_open(cells, n);
    }
    v->counts.overlapping += set;
    return is_open;
}

/* The rows of triangle t of a crowd in the layers asked. */
static void set_rows(voxels *v, const crowd *c, unsigned t, tribox_shape shape, const tribox_limits *limits)
{
    const tribox_strip *const strip = &c->strip;
    const row_range r = {
        .base = (int64_t)strip->base[0][t],
        .first_j = (int64_t)strip->base[1][t],
        .first_k = (int64_t)strip->base[2][t],
        .wide = (int64_t)strip->cells[1][t],
        .word = c->word[t],
        .skip = ((ptrdiff_t)v->grid->size[1] - (ptrdiff_t)strip->cells[1][t]) * (ptrdiff_t)v->row_words,
        .bit = c->bit[t],
        .is_narrow = c->bit[t] + strip->cells[0][t] < 64,
    };
    const int64_t first_layer = most_of(v->first_layer - r.first_k, 0);
    const int64_t end = least_of((int64_t)strip->cells[2][t], v->end_layer - r.first_k) * r.wide;
    row_place at = place_of(v, &r, 0, first_layer);
    for (int64_t row = first_layer * r.wide; row < end; row += 64) {
        const unsigned rows = (unsigned)least_of(end - row, 64);
        tribox_row_cells cells;
        v->plan.kernel->grid->rows[shape](limits, t, (double)row, rows, &cells);
        if (v->plan.accuracy == TRIBOX_CONSERVATIVE) {
            memcpy(cells.first_sure, cells.first_maybe, sizeof cells.first_sure);
            memcpy(cells.end_sure, cells.end_maybe, sizeof cells.end_sure);
        }
        if ((r.is_narrow ? set_narrow_rows : set_wide_rows)(v, &r, at, rows, &cells))
            add_open_rows(v, strip, t, &r, at, rows, &cells);
        if (row + 64 < end)
            at = place_of(v, &r, (row + 64) % r.wide, (row + 64) / r.wide);
    }
}

static void set_crowd(voxels *v, tribox_shape shape)
{
    crowd *const c = &v->crowds[shape];
    tribox_strip *const strip = &c->strip;
    tribox_limits limits;
    if (!strip->count)
        return;
    for (unsigned t = strip->count; t % TRIBOX_DOUBLES_MAX; t++) {
        for (int n = 0; n < 9; n++)
            strip->u[n][t] = strip->u[n][strip->count - 1];
        for (int a = 0; a < 3; a++) {
            strip->base[a][t] = strip->base[a][strip->count - 1];
            strip->cells[a][t] = strip->cells[a][strip->count - 1];
        }
    }
    v->plan.kernel->grid->prepare[shape](strip, &v->lattice, v->plan.axes, v->plan.accuracy == TRIBOX_FAST ? 0 : 1, &limits);
    for (unsigned t = 0; t < strip->count; t++)
        set_rows(v, c, t, shape, &limits);
    strip->count = 0;
}

/* Triangle i of the soup joins the crowd of its shape. */
static void join_crowd(voxels *v, const tribox_soup *soup, size_t i, const tribox_touched *touched, tribox_shape shape)
{
    const unsigned lane = i % 64;
    crowd *const c = &v->crowds[shape];
    tribox_strip *const strip = &c->strip;
    const unsigned t = strip->count;
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < 3; j++)
            strip->u[3 * a + j][t] = tribox_soup_axis(soup, a)[j][i];
        strip->base[a][t] = touched->base[a][lane];
        strip->cells[a][t] = touched->cells[a][lane];
    }
    c->word[t] = touched->word[lane];
    c->bit[t] = touched->bit[lane];
    if (++strip->count == TRIBOX_STRIP)
        set_crowd(v, shape);
}

/* Where its box spans one cell on two axes, a triangle overlaps every cell that it spans on the third. */
static void set_line(voxels *v, const tribox_touched *touched, unsigned lane)
{
    const int64_t along = (int64_t)touched->cells[0][lane], rows = (int64_t)touched->cells[1][lane];
    const int64_t first_k = (int64_t)touched->base[2][lane], end_k = first_k + (int64_t)touched->cells[2][lane];
    size_t set = 0;
    for (int64_t k = most_of(first_k, v->first_layer); k < least_of(end_k, v->end_layer); k++) {
        uint64_t *row = v->occupied + touched->word[lane] + (k - first_k) * (int64_t)v->grid->size[1] * (int64_t)v->row_words;
        for (int64_t j = 0; j < rows; j++, row += v->row_words)
            set += set_cells(row, touched->bit[lane], touched->bit[lane] + along - 1);
    }
    v->counts.overlapping += set;
}

/* What the planes say of triangle i of the soup, which the kernel was not sure of. */
static void tell_by_planes(const voxels *v, const tribox_soup *soup, size_t i, tribox_touched *touched, uint64_t *touching)
{
    const unsigned lane = i % 64;
    const uint64_t bit = UINT64_C(1) << lane;
    bool is_inside = true;
    int64_t base[3];
    for (int a = 0; a < 3; a++) {
        const float *const *const stream = tribox_soup_axis(soup, a);
        float least = stream[0][i], most = least;
        for (int j = 1; j < 3; j++) {
            least = stream[j][i] < least ? stream[j][i] : least;
            most = stream[j][i] > most ? stream[j][i] : most;
        }
        const tribox_cells cells = tribox_grid_cells(v->grid, a, least, most);
        const int64_t from = a == 2 ? v->first_layer : 0, end = a == 2 ? v->end_layer : v->grid->size[a];
        is_inside &= cells.first < end && cells.last >= from;
        base[a] = most_of(cells.first, 0);
        touched->base[a][lane] = (double)base[a];
        touched->cells[a][lane] = (double)(least_of(cells.last + 1, v->grid->size[a]) - base[a]);
        touched->spans[a] = cells.last > cells.first ? touched->spans[a] | bit : touched->spans[a] & ~bit;
    }
    touched->word[lane] =
        (int32_t)(((base[2] - v->first_layer) * v->grid->size[1] + base[1]) * (int64_t)v->row_words + base[0] / 64);
    touched->bit[lane] = (int32_t)(base[0] % 64);
    if (!is_inside)
        *touching &= ~bit;
}

static void set_word(voxels *v, const tribox_soup *soup, size_t word)
{
    tribox_touched touched;
    uint64_t touching = v->plan.kernel->grid->touched(soup, word, &v->lattice, &touched);
    for (uint64_t left = touched.unsure; left; left &= left - 1)
        tell_by_planes(v, soup, 64 * word + tribox_lowest_bit(left), &touched, &touching);
    const uint64_t x = touched.spans[0], y = touched.spans[1], z = touched.spans[2];

    size_t set = 0;
    for (uint64_t left = touching & ~(x | y | z); left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        set += set_bits(v->occupied + touched.word[lane], UINT64_C(1) << touched.bit[lane]);
    }
    v->counts.overlapping += set;
    for (uint64_t left = touching & (x ^ y ^ z) & ~(x & y & z); left; left &= left - 1)
        set_line(v, &touched, tribox_lowest_bit(left));

    uint64_t shaped[TRIBOX_SHAPES] = {x & y & z, ~x & y & z, x & ~y & z, x & y & ~z};
    if (!(v->plan.axes & TRIBOX_AXES_EDGES)) { /* a shadow is told by edges */
        shaped[TRIBOX_SOLID] = (x & y) | (y & z) | (z & x);
        shaped[TRIBOX_FLAT_X] = shaped[TRIBOX_FLAT_Y] = shaped[TRIBOX_FLAT_Z] = 0;
    }
    for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
        for (uint64_t left = touching & shaped[shape]; left; left &= left - 1)
            join_crowd(v, soup, 64 * word + tribox_lowest_bit(left), &touched, shape);
}

static tribox_lattice lattice_of(const tribox_grid *grid, uint32_t first, uint32_t layers)
{
    tribox_lattice lattice = {
        .first_layer = first, .end_layer = (double)first + layers, .row_words = (double)tribox_grid_row_words(grid)};
    for (int a = 0; a < 3; a++) {
        const double lowest = tribox_grid_plane(grid, a, 0), highest = tribox_grid_plane(grid, a, grid->size[a]);
        const double farthest = -lowest > highest ? -lowest : highest;
        lattice.origin[a] = grid->origin[a];
        lattice.per_cell[a] = 1 / (double)grid->cell[a];
        lattice.size[a] = grid->size[a];
        /* planes: half a spacing of floats, and of doubles while they are made; places: three roundings in double */
        lattice.error[a] = (0x1.001p-24 * farthest + 0x1p-149) * lattice.per_cell[a] + 0x1p-50 * (lattice.size[a] + 4);
    }
    return lattice;
}

static void set_soup(voxels *v, const tribox_soup *soup)
{
    for (size_t word = 0; word < soup->count / 64; word++)
        set_word(v, soup, word);
    if (soup->count % 64) {
        float scratch[9][64];
        for (int k = 0; k < 9; k++)
            for (int i = 0; i < 64; i++)
                scratch[k][i] = NAN; /* no triangle */
        const tribox_soup tail = tribox_soup_tail(soup, scratch);
        set_word(v, &tail, 0);
    }
    for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
        set_crowd(v, shape);
    settle_open_cells(v);
}

/* Without the box normals a triangle may overlap cells anywhere: every cell is asked by its own box. */
static void set_soup_by_cells(voxels *v, const tribox_soup *soup)
{
    for (size_t t = 0; t < soup->count; t++) {
        float u[9];
        for (int k = 0; k < 9; k++)
            u[k] = tribox_soup_axis(soup, k / 3)[k % 3][t];
        const float triangle[3][3] = {{u[0], u[3], u[6]}, {u[1], u[4], u[7]}, {u[2], u[5], u[8]}};
        if (tribox_triangle_is_finite(triangle))
            for (int64_t k = v->first_layer; k < v->end_layer; k++)
                for (int64_t j = 0; j < v->grid->size[1]; j++)
                    add_open_cells(v, u, row_words_at(v, j, k), 0, (int64_t)v->grid->size[0] - 1, j, k);
    }
    settle_open_cells(v);
}

tribox_status tribox_voxelize_layers(const tribox_soup *soup, const tribox_grid *grid, uint32_t first, uint32_t layers,
                                     const tribox_options *options, uint64_t *occupied, tribox_report *report)
{
    voxels v;
    if (!grid || !occupied || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = tribox_plan_make(options, &v.plan);
    if (status)
        return status;

    const tribox_environment callers = tribox_environment_enter();
    const bool is_sound = tribox_grid_is_sound(grid),
               has_layers = is_sound && first <= grid->size[2] && layers <= grid->size[2] - first;
    if (has_layers) {
        v.grid = grid;
        v.lattice = lattice_of(grid, first, layers);
        v.first_layer = first;
        v.end_layer = (int64_t)first + layers;
        v.row_words = tribox_grid_row_words(grid);
        v.occupied = occupied;
        v.counts = (tribox_report){0, 0};
        v.open = 0;
        for (tribox_shape shape = TRIBOX_SOLID; shape < TRIBOX_SHAPES; shape++)
            v.crowds[shape].strip.count = 0;
        (v.plan.axes & TRIBOX_AXES_BOX ? set_soup : set_soup_by_cells)(&v, soup);
        tribox_plan_report(&v.plan, v.counts, report);
    }
    tribox_environment_leave(callers);
    return has_layers ? TRIBOX_OK : is_sound ? TRIBOX_BAD_ARGUMENT : TRIBOX_BAD_GRID;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *occupied,
                              tribox_report *report)
{
    return tribox_voxelize_layers(soup, grid, 0, grid ? grid->size[2] : 0, options, occupied, report);
}
