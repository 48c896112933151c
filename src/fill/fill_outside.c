/*
 * fill_outside.c - what a surface encloses: the outside spreads through free cells, and what it does not reach is solid.
 *
 * The first sweep takes every row once, while the rows next to it are in the nearest cache, and notes which rows it has left behind
 * that could be reached from where it went. Sweeps back and forth then take the rows noted, until there are none.
 */
#include "fill_row.h"
#include "grid/grid_cells.h"

/* Layers with rows that are noted; none where from > to. */
typedef struct span {
    size_t from, to;
} span;

static const span none = {SIZE_MAX, 0};

static void extend(span *layers, size_t k)
{
    layers->from = k < layers->from ? k : layers->from;
    layers->to = k > layers->to ? k : layers->to;
}

typedef struct flood {
    tribox_rows rows;
    size_t lines, layers; /* rows of a layer, and layers that were started */
    size_t last_layer;
    const uint64_t *occupied;
    uint64_t *solid; /* cells that are not reached */
    uint64_t *noted; /* rows with free cells next to reached ones of other rows */
    uint64_t *done;  /* rows whose free cells are all reached */
    span now, next;  /* layers of this sweep and of the next */
    bool is_upwards; /* this sweep */
    size_t inside;   /* free cells that are not reached, in the rows that were started */
} flood;

static const uint64_t *occupied_row(const flood *f, size_t row) { return f->occupied + row * f->rows.words; }

static uint64_t *solid_row(const flood *f, size_t row) { return f->solid + row * f->rows.words; }

/* Whether a row has a free cell next to a reached one of `from`: if so it is noted. */
static bool is_noted(const flood *f, const uint64_t *from, size_t row)
{
    const bool is_done = f->done[row / 64] >> row % 64 & 1;
    const bool is_next = !is_done && tribox_row_is_next_to(f->rows.words, from, occupied_row(f, row), solid_row(f, row));
    if (is_next)
        f->noted[row / 64] |= UINT64_C(1) << row % 64;
    return is_next;
}

/* The rows around row j of layer k that were started. */
static void note_neighbours(flood *f, size_t j, size_t k)
{
    const size_t row = k * f->lines + j;
    const uint64_t *const solid = solid_row(f, row);
    if (j)
        is_noted(f, solid, row - 1);
    if (j + 1 < f->lines)
        is_noted(f, solid, row + 1);
    if (k && is_noted(f, solid, row - f->lines))
        extend(f->is_upwards ? &f->next : &f->now, k - 1);
    if (k + 1 < f->layers && is_noted(f, solid, row + f->lines))
        extend(f->is_upwards ? &f->now : &f->next, k + 1);
}

/* What has come into a row spreads; what is left of its free cells is counted. */
static void settle_row(flood *f, size_t row, bool has_left)
{
    const uint64_t last = f->rows.last, *const occupied = occupied_row(f, row);
    uint64_t *const solid = solid_row(f, row);
    if (has_left && tribox_row_is_open(f->rows.words, last, occupied, solid))
        tribox_row_close(f->rows.words, last, occupied, solid);
    const size_t left = has_left ? tribox_row_left(f->rows.words, occupied, solid) : 0;
    f->inside += left;
    f->done[row / 64] |= (uint64_t)!left << row % 64;
}

/* A row for the first time: from its ends, from the rows before it on both axes, and at the border of the grid from all around. */
static void start_row(flood *f, size_t j, size_t k)
{
    const size_t words = f->rows.words, row = k * f->lines + j;
    const bool is_border = j == 0 || k == 0 || j + 1 == f->lines || k == f->last_layer;
    const uint64_t last = f->rows.last, *const occupied = occupied_row(f, row);
    uint64_t *const solid = solid_row(f, row);
    bool has_left = false;
    if (is_border)
        tribox_row_open(words, last, occupied, solid);
    else
        has_left = tribox_row_start(words, last, occupied, solid - words, solid - f->lines * words, solid);
    settle_row(f, row, has_left);
    if (j)
        is_noted(f, solid, row - 1);
    if (k && is_noted(f, solid, row - f->lines))
        extend(&f->next, k - 1);
}

/* A row that was noted: from the rows next to it. It is within the grid, as all of a row at its border is reached at once. */
static void take_row(flood *f, size_t j, size_t k)
{
    const size_t words = f->rows.words, row = k * f->lines + j, layer = f->lines * words;
    const uint64_t *const occupied = occupied_row(f, row);
    uint64_t *const solid = solid_row(f, row);
    f->noted[row / 64] &= ~(UINT64_C(1) << row % 64);
    f->inside -= tribox_row_left(words, occupied, solid);
    tribox_row_take(words, occupied, solid - words, solid + words, solid - layer, k + 1 < f->layers ? solid + layer : solid - layer,
                    solid);
    settle_row(f, row, true);
    note_neighbours(f, j, k);
}

/* The first noted row from `row` on, or `end`. */
static size_t next_noted(const flood *f, size_t row, size_t end)
{
    while (row < end) {
        const uint64_t bits = f->noted[row / 64] >> row % 64;
        if (bits) {
            row += tribox_lowest_bit(bits);
            return row < end ? row : end;
        }
        row = (row / 64 + 1) * 64;
    }
    return end;
}

/* The row after the last noted one below `end`, or `first`. */
static size_t previous_noted(const flood *f, size_t first, size_t end)
{
    while (end > first) {
        const uint64_t bits = f->noted[(end - 1) / 64] << (63 - (end - 1) % 64);
        if (bits) {
            end -= 64 - tribox_bit_length(bits);
            return end > first ? end : first;
        }
        end = (end - 1) / 64 * 64;
    }
    return first;
}

/* Down and up the noted rows of a layer until there are none. */
static void take_layer(flood *f, size_t k)
{
    const size_t first = k * f->lines, end = first + f->lines;
    while (next_noted(f, first, end) < end) {
        for (size_t after = previous_noted(f, first, end); after > first; after = previous_noted(f, first, after - 1))
            take_row(f, after - 1 - first, k);
        for (size_t row = next_noted(f, first, end); row < end; row = next_noted(f, row + 1, end))
            take_row(f, row - first, k);
    }
}

/* The first sweep, upwards. */
static void start_layers(flood *f)
{
    f->is_upwards = true;
    for (size_t k = 0; k <= f->last_layer; k++) {
        f->layers = k + 1;
        for (size_t j = 0; j < f->lines; j++)
            start_row(f, j, k);
        take_layer(f, k);
    }
}

/* Noted rows ahead prolong a sweep; those behind wait for the next. */
static void take_layers(flood *f)
{
    f->is_upwards = !f->is_upwards;
    f->now = f->next;
    f->next = none;
    if (f->is_upwards)
        for (size_t k = f->now.from; k <= f->now.to; k++)
            take_layer(f, k);
    else
        for (size_t k = f->now.to + 1; k-- > f->now.from;)
            take_layer(f, k);
}

tribox_status tribox_fill_outside(const uint32_t size[3], const uint64_t *occupied, void *scratch, uint64_t *solid, size_t *inside)
{
    if (!size || !occupied || !solid || !scratch)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_fill_is_served(size))
        return TRIBOX_BAD_GRID;
    flood f = {.rows = tribox_rows_of(size), .lines = size[1], .last_layer = size[2] - 1, .occupied = occupied, .solid = solid};
    f.noted = tribox_fill_row_bits(scratch, &f.rows);
    f.done = f.noted + tribox_words_of(f.rows.count);
    f.now = f.next = none;
    start_layers(&f);
    while (f.next.from <= f.next.to)
        take_layers(&f);
    if (inside)
        *inside = f.inside;
    return TRIBOX_OK;
}
