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
#include "exact.h"
#include "grid.h"
#include "settle.h"
#include "soup.h"

/* The cells of a triangle's range: first, and how many, on each axis, within the grid. */
typedef struct range {
    int64_t first[3], cells[3];
} range;

/* Triangles of one shape that wait for their rows. */
typedef struct crowd {
    tribox_strip strip;
    range range[TRIBOX_STRIP];
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

static void set_bits(voxels *v, uint64_t *word, uint64_t bits)
{
    const uint64_t before = *word;
    *word = before | bits;
    v->counts.overlapping += tribox_count_bits(bits & ~before);
}

static uint64_t *row_of(const voxels *v, int64_t j, int64_t k)
{
    return v->occupied + ((size_t)(k - v->first_layer) * v->grid->size[1] + (size_t)j) * v->row_words;
}

/* Cells first to last of a row, a word at a time. */
static void set_cells(voxels *v, uint64_t *row, int64_t first, int64_t last)
{
    const size_t end = (size_t)last / 64;
    uint64_t from = ~UINT64_C(0) << first % 64;
    for (size_t w = (size_t)first / 64; w <= end; w++, from = ~UINT64_C(0))
        set_bits(v, row + w, w < end ? from : from & ~UINT64_C(0) >> (63 - last % 64));
}

static void settle_open(voxels *v)
{
    if (!v->open)
        return;
    v->counts.undecided += v->open;
    for (uint64_t left = tribox_settle_batch(&v->batch, v->open, ~UINT64_C(0), &v->plan); left; left &= left - 1) {
        const unsigned i = tribox_lowest_bit(left);
        set_bits(v, v->cell[i].word, v->cell[i].bit);
    }
    v->open = 0;
}

/* Cells first to last of row (j, k), of which only their own boxes can tell; those that are set need no answer. */
static void settle_cells(voxels *v, const float u[9], uint64_t *row, int64_t first, int64_t last, int64_t j, int64_t k)
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
            settle_open(v);
    }
}

/* Where a walk over the rows of a range stands. */
typedef struct row_place {
    int64_t j, k;
} row_place;

static void next_row(row_place *at, const range *in)
{
    if (++at->j == in->first[1] + in->cells[1]) {
        at->j = in->first[1];
        at->k++;
    }
}

/* The cells of rows that may overlap, and not surely do. */
static void settle_rows(voxels *v, const tribox_strip *strip, unsigned t, const range *in, row_place at, unsigned rows,
                        const tribox_row_cells *cells)
{
    float u[9];
    for (int n = 0; n < 9; n++)
        u[n] = strip->u[n][t];
    for (unsigned n = 0; n < rows; n++, next_row(&at, in)) {
        const bool has_sure = cells->first_sure[n] < cells->end_sure[n];
        const int64_t base = in->first[0], first = base + cells->first_maybe[n], end = base + cells->end_maybe[n];
        const int64_t sure = has_sure ? base + cells->first_sure[n] : end, sure_end = has_sure ? base + cells->end_sure[n] : end;
        settle_cells(v, u, row_of(v, at.j, at.k), first, sure - 1, at.j, at.k);
        settle_cells(v, u, row_of(v, at.j, at.k), sure_end, end - 1, at.j, at.k);
    }
}

/* The bits below bit n, which is at most 63. */
static uint64_t bits_below(int n) { return (UINT64_C(1) << n) - 1; }

/* Rows whose cells all lie in one word, without a branch on what they hold. Whether any is open. */
static bool set_narrow_rows(voxels *v, const range *in, row_place at, unsigned rows, const tribox_row_cells *cells)
{
    const int shift = (int)(in->first[0] % 64);
    const size_t skip = v->row_words * (size_t)((int64_t)v->grid->size[1] - in->cells[1]);
    uint64_t *word = row_of(v, at.j, at.k) + in->first[0] / 64, open = 0;
    int64_t left = in->first[1] + in->cells[1] - at.j;
    size_t set = 0;
    for (unsigned n = 0; n < rows; n++) {
        const uint64_t maybe = bits_below(cells->end_maybe[n]) & ~bits_below(cells->first_maybe[n]);
        const uint64_t sure = bits_below(cells->end_sure[n]) & ~bits_below(cells->first_sure[n]);
        const uint64_t before = *word;
        *word = before | sure << shift;
        set += tribox_count_bits(sure & ~(before >> shift));
        open |= maybe & ~sure;
        word += v->row_words;
        if (--left == 0) {
            left = in->cells[1];
            word += skip;
        }
    }
    v->counts.overlapping += set;
    return open;
}

static bool set_wide_rows(voxels *v, const range *in, row_place at, unsigned rows, const tribox_row_cells *cells)
{
    bool is_open = false;
    for (unsigned n = 0; n < rows; n++, next_row(&at, in)) {
        if (cells->first_maybe[n] >= cells->end_maybe[n])
            continue;
        if (cells->first_sure[n] < cells->end_sure[n])
            set_cells(v, row_of(v, at.j, at.k), in->first[0] + cells->first_sure[n], in->first[0] + cells->end_sure[n] - 1);
        is_open |= cells->first_maybe[n] != cells->first_sure[n] || cells->end_maybe[n] != cells->end_sure[n];
    }
    return is_open;
}

/* The rows of triangle t of a crowd in the layers asked. */
static void set_rows(voxels *v, const crowd *c, unsigned t, tribox_shape shape, const tribox_limits *limits)
{
    const range *const in = &c->range[t];
    const bool is_narrow = in->first[0] % 64 + in->cells[0] < 64;
    const int64_t first_layer = most_of(in->first[2], v->first_layer);
    const int64_t end = (least_of(in->first[2] + in->cells[2], v->end_layer) - in->first[2]) * in->cells[1];
    for (int64_t row = (first_layer - in->first[2]) * in->cells[1]; row < end; row += 64) {
        const row_place at = {in->first[1] + row % in->cells[1], in->first[2] + row / in->cells[1]};
        const unsigned rows = (unsigned)least_of(end - row, 64);
        tribox_row_cells cells;
        v->plan.kernel->grid->rows[shape](limits, t, (double)row, rows, &cells);
        if (v->plan.accuracy == TRIBOX_CONSERVATIVE) {
            memcpy(cells.first_sure, cells.first_maybe, sizeof cells.first_sure);
            memcpy(cells.end_sure, cells.end_maybe, sizeof cells.end_sure);
        }
        if ((is_narrow ? set_narrow_rows : set_wide_rows)(v, in, at, rows, &cells))
            settle_rows(v, &c->strip, t, in, at, rows, &cells);
    }
}

static void set_crowd(voxels *v, tribox_shape shape)
{
    crowd *const c = &v->crowds[shape];
    tribox_strip *const strip = &c->strip;
    tribox_limits limits;
    if (!strip->count)
        return;
    for (unsigned t = strip->count; t % 8; t++) {
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

/* Triangle i of the soup joins the crowd of its shape; of a range longer than rows may be, piece after piece. */
static void join_crowd(voxels *v, const tribox_soup *soup, size_t i, range r, tribox_shape shape)
{
    const int64_t piece = INT64_C(1) << 30, end = r.first[0] + r.cells[0];
    crowd *const c = &v->crowds[shape];
    tribox_strip *const strip = &c->strip;
    for (; r.first[0] < end; r.first[0] += piece) {
        const unsigned t = strip->count;
        r.cells[0] = least_of(end - r.first[0], piece);
        c->range[t] = r;
        for (int j = 0; j < 3; j++) {
            strip->u[3 * j][t] = soup->x[j][i];
            strip->u[3 * j + 1][t] = soup->y[j][i];
            strip->u[3 * j + 2][t] = soup->z[j][i];
        }
        for (int a = 0; a < 3; a++) {
            strip->base[a][t] = (double)r.first[a];
            strip->cells[a][t] = (double)r.cells[a];
        }
        if (++strip->count == TRIBOX_STRIP)
            set_crowd(v, shape);
    }
}

/* Where the triangle's box spans one cell on two axes, it overlaps every cell that it spans on the third. */
static void set_line(voxels *v, const range *r)
{
    if (r->cells[0] > 1) {
        set_cells(v, row_of(v, r->first[1], r->first[2]), r->first[0], r->first[0] + r->cells[0] - 1);
        return;
    }
    for (int64_t k = r->first[2]; k < r->first[2] + r->cells[2]; k++)
        for (int64_t j = r->first[1]; k >= v->first_layer && k < v->end_layer && j < r->first[1] + r->cells[1]; j++)
            set_bits(v, row_of(v, j, k) + r->first[0] / 64, UINT64_C(1) << r->first[0] % 64);
}

/* The cells of triangle i of the soup, from the planes themselves. */
static void tell_by_planes(const voxels *v, const tribox_soup *soup, size_t i, tribox_reach *reach)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    for (int a = 0; a < 3; a++) {
        float least = streams[a][0][i], most = least;
        for (int j = 1; j < 3; j++) {
            least = streams[a][j][i] < least ? streams[a][j][i] : least;
            most = streams[a][j][i] > most ? streams[a][j][i] : most;
        }
        const tribox_cells cells = tribox_grid_cells(v->grid, a, least, most);
        reach->first[a][i % 64] = (double)cells.first;
        reach->last[a][i % 64] = (double)cells.last;
    }
}

/* What of a triangle's cells lies within the grid; bit a of *spans tells that it has more than one on axis a, be they outside. */
static bool clip(const voxels *v, const tribox_reach *reach, unsigned lane, range *r, unsigned *spans)
{
    *spans = 0;
    for (int a = 0; a < 3; a++) {
        const int64_t first = (int64_t)reach->first[a][lane], last = (int64_t)reach->last[a][lane];
        *spans |= (unsigned)(last > first) << a;
        r->first[a] = most_of(first, 0);
        r->cells[a] = least_of(last + 1, v->grid->size[a]) - r->first[a];
        if (r->cells[a] <= 0)
            return false;
    }
    return r->first[2] < v->end_layer && r->first[2] + r->cells[2] > v->first_layer;
}

static void set_word(voxels *v, const tribox_soup *soup, size_t word)
{
    static const unsigned char shapes[8] = {[3] = TRIBOX_FLAT_Z, [5] = TRIBOX_FLAT_Y, [6] = TRIBOX_FLAT_X, [7] = TRIBOX_SOLID};
    tribox_reach reach;
    for (uint64_t left = v->plan.kernel->grid->reach(soup, word, &v->lattice, &reach); left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        const size_t i = 64 * word + lane;
        range r;
        unsigned spans;
        if (reach.unsure >> lane & 1)
            tell_by_planes(v, soup, i, &reach);
        if (!clip(v, &reach, lane, &r, &spans))
            continue;
        if (!(spans & (spans - 1)))
            set_line(v, &r);
        else
            join_crowd(v, soup, i, r, v->plan.axes & TRIBOX_AXES_EDGES ? shapes[spans] : TRIBOX_SOLID);
    }
}

static tribox_lattice lattice_of(const tribox_grid *grid, uint32_t first, uint32_t layers)
{
    tribox_lattice lattice = {.first_layer = first, .end_layer = (double)first + layers};
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
    settle_open(v);
}

/* Without the box normals a triangle may overlap cells anywhere: every cell is asked by its own box. */
static void set_soup_by_cells(voxels *v, const tribox_soup *soup)
{
    for (size_t t = 0; t < soup->count; t++) {
        float u[9];
        for (int j = 0; j < 3; j++) {
            u[3 * j] = soup->x[j][t];
            u[3 * j + 1] = soup->y[j][t];
            u[3 * j + 2] = soup->z[j][t];
        }
        const float triangle[3][3] = {{u[0], u[1], u[2]}, {u[3], u[4], u[5]}, {u[6], u[7], u[8]}};
        if (tribox_triangle_is_finite(triangle))
            for (int64_t k = v->first_layer; k < v->end_layer; k++)
                for (int64_t j = 0; j < v->grid->size[1]; j++)
                    settle_cells(v, u, row_of(v, j, k), 0, (int64_t)v->grid->size[0] - 1, j, k);
    }
    settle_open(v);
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
        if (v.plan.accuracy == TRIBOX_FAST)
            v.counts.undecided = 0;
        if (report)
            *report = v.counts;
    }
    tribox_environment_leave(callers);
    return has_layers ? TRIBOX_OK : is_sound ? TRIBOX_BAD_ARGUMENT : TRIBOX_BAD_GRID;
}

tribox_status tribox_voxelize(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, uint64_t *occupied,
                              tribox_report *report)
{
    return tribox_voxelize_layers(soup, grid, 0, grid ? grid->size[2] : 0, options, occupied, report);
}
