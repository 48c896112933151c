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

/* One call. */
typedef struct voxels {
    const tribox_grid *grid;
    tribox_plan plan;
    tribox_lattice lattice;
    int64_t first_layer, end_layer;
    size_t row_words;
    uint64_t *occupied; /* of the first layer */
    tribox_report counts;
    /* cells that are open */
    tribox_batch batch;
    unsigned open;
    struct {
        uint64_t *word, bit;
    } cell[TRIBOX_BATCH];
} voxels;

/* The cells of a triangle's range: first, and how many, on each axis, within the grid. */
typedef struct range {
    int64_t first[3], cells[3];
} range;

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

/* A row that has open cells besides its sure ones. */
static void set_open_row(voxels *v, const tribox_strip *strip, unsigned t, const tribox_row_cells *cells, unsigned n, int64_t i,
                         int64_t j, int64_t k)
{
    uint64_t *const row = row_of(v, j, k);
    const int64_t first = i + (int64_t)cells->first_maybe[n], last = i + (int64_t)cells->last_maybe[n];
    int64_t sure = i + (int64_t)cells->first_sure[n], last_sure = i + (int64_t)cells->last_sure[n];
    if (sure <= last_sure)
        set_cells(v, row, sure, last_sure);
    else
        sure = (last_sure = last) + 1;
    float u[9];
    for (int number = 0; number < 9; number++)
        u[number] = strip->u[number][t];
    settle_cells(v, u, row, first, sure - 1, j, k);
    settle_cells(v, u, row, last_sure + 1, last, j, k);
}

/* The rows of triangle t of the strip in the layers asked. */
static void set_rows(voxels *v, const tribox_strip *strip, unsigned t, const range *r)
{
    const bool is_exact = v->plan.accuracy == TRIBOX_EXACT;
    tribox_rows_walk *const walk = is_exact ? v->plan.kernel->grid->rows : v->plan.kernel->grid->rows_maybe;
    const int64_t first_layer = r->first[2] > v->first_layer ? r->first[2] : v->first_layer;
    const int64_t end = r->first[2] + r->cells[2] < v->end_layer ? r->first[2] + r->cells[2] : v->end_layer;
    const int64_t wide = r->cells[1], rows = (end - r->first[2]) * wide;
    int64_t j = r->first[1], k = first_layer;
    uint64_t *row = row_of(v, j, k);
    for (int64_t at = (first_layer - r->first[2]) * wide; at < rows; at += 64) {
        tribox_row_cells cells;
        const unsigned count = rows - at < 64 ? (unsigned)(rows - at) : 64;
        walk(strip, t, (double)at, count, &cells);
        for (unsigned n = 0; n < count; n++) {
            const int64_t first = (int64_t)cells.first_maybe[n], last = (int64_t)cells.last_maybe[n];
            if (first <= last) {
                if (is_exact && (cells.first_sure[n] != cells.first_maybe[n] || cells.last_sure[n] != cells.last_maybe[n]))
                    set_open_row(v, strip, t, &cells, n, r->first[0], j, k);
                else
                    set_cells(v, row, r->first[0] + first, r->first[0] + last);
            }
            row += v->row_words;
            if (++j == r->first[1] + wide) {
                j = r->first[1];
                row = row_of(v, j, ++k);
            }
        }
    }
}

static void set_strip(voxels *v, tribox_strip *strip, const range ranges[TRIBOX_STRIP])
{
    for (unsigned t = strip->count; t % 8; t++) {
        for (int n = 0; n < 9; n++)
            strip->u[n][t] = strip->u[n][strip->count - 1];
        for (int a = 0; a < 3; a++) {
            strip->base[a][t] = strip->base[a][strip->count - 1];
            strip->cells[a][t] = strip->cells[a][strip->count - 1];
        }
    }
    v->plan.kernel->grid->prepare(strip, &v->lattice, v->plan.axes, v->plan.accuracy == TRIBOX_FAST ? 0 : 1);
    for (unsigned t = 0; t < strip->count; t++)
        set_rows(v, strip, t, &ranges[t]);
    strip->count = 0;
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

/* What of a triangle's cells lies within the grid; *spans: on how many axes it has more than one, be they outside. */
static bool clip(const voxels *v, const tribox_reach *reach, unsigned lane, range *r, int *spans)
{
    *spans = 0;
    for (int a = 0; a < 3; a++) {
        const int64_t first = (int64_t)reach->first[a][lane], last = (int64_t)reach->last[a][lane], size = v->grid->size[a];
        *spans += last > first;
        r->first[a] = first > 0 ? first : 0;
        r->cells[a] = (last < size ? last + 1 : size) - r->first[a];
        if (r->cells[a] <= 0)
            return false;
    }
    return r->first[2] < v->end_layer && r->first[2] + r->cells[2] > v->first_layer;
}

static void set_word(voxels *v, const tribox_soup *soup, size_t word)
{
    tribox_reach reach;
    tribox_strip strip;
    range ranges[TRIBOX_STRIP];
    strip.count = 0;
    for (uint64_t left = v->plan.kernel->grid->reach(soup, word, &v->lattice, &reach); left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        const size_t i = 64 * word + lane;
        range *const r = &ranges[strip.count];
        int spans;
        if (reach.unsure >> lane & 1)
            tell_by_planes(v, soup, i, &reach);
        if (!clip(v, &reach, lane, r, &spans))
            continue;
        if (spans <= 1) {
            set_line(v, r);
            continue;
        }
        for (int j = 0; j < 3; j++) {
            strip.u[3 * j][strip.count] = soup->x[j][i];
            strip.u[3 * j + 1][strip.count] = soup->y[j][i];
            strip.u[3 * j + 2][strip.count] = soup->z[j][i];
        }
        for (int a = 0; a < 3; a++) {
            strip.base[a][strip.count] = (double)r->first[a];
            strip.cells[a][strip.count] = (double)r->cells[a];
        }
        if (++strip.count == TRIBOX_STRIP)
            set_strip(v, &strip, ranges);
    }
    if (strip.count)
        set_strip(v, &strip, ranges);
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
