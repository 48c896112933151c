/*
 * fill_outside.c - what a surface encloses: the outside spreads through free cells, and what it does not reach is solid.
 *
 * The first sweep takes every row once, while the rows beside it are in the nearest cache, and notes which rows it has left behind
 * that could be reached from where it went. Sweeps back and forth then take the rows noted, until there are none.
 */
#include "fill.h"
#include "grid_cells.h"

tribox_rows tribox_rows_of(const uint32_t size[3])
{
    return (tribox_rows){
        .words = tribox_words_of(size[0]), .count = (size_t)size[1] * size[2], .last = ~UINT64_C(0) >> (63 - (size[0] - 1) % 64)};
}

bool tribox_fill_is_served(const uint32_t size[3]) { return size[0] && size[1] && size[2] && tribox_has_few_words(size); }

size_t tribox_fill_bytes(const uint32_t size[3])
{
    const uint64_t rows = (uint64_t)size[1] * size[2], bytes = (rows / 64 + 2) * sizeof(uint64_t);
    return bytes > SIZE_MAX ? SIZE_MAX : (size_t)bytes;
}

uint64_t *tribox_fill_row_bits(void *scratch, const tribox_rows *rows)
{
    const size_t off = (uintptr_t)scratch % sizeof(uint64_t);
    uint64_t *const bits = (uint64_t *)(void *)((char *)scratch + (off ? sizeof(uint64_t) - off : 0));
    memset(bits, 0, tribox_words_of(rows->count) * sizeof *bits);
    return bits;
}

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
    uint64_t *noted; /* rows with free cells beside reached ones of other rows */
    span now, next;  /* layers of this sweep and of the next */
    bool is_upwards; /* this sweep */
    size_t inside;   /* free cells that are not reached, in the rows that were started */
} flood;

static const uint64_t *occupied_row(const flood *f, size_t row) { return f->occupied + row * f->rows.words; }

static uint64_t *solid_row(const flood *f, size_t row) { return f->solid + row * f->rows.words; }

/* Every bit of `is_free` above a seed, up to the end of its run, and the seeds: a run turns to zeros as the carry goes through it. */
static uint64_t spread_up(uint64_t seeds, uint64_t is_free) { return (is_free & ~(is_free + seeds)) | seeds; }

static uint64_t spread_down(uint64_t seeds, uint64_t is_free)
{
    for (int step = 1; step < 64; step *= 2) {
        seeds |= is_free & seeds >> step;
        is_free &= is_free >> step;
    }
    return seeds;
}

/* From the end of the row towards its start. Returns how many cells of the row are free and not reached. */
static size_t spread_row_down(const flood *f, const uint64_t *occupied, uint64_t *solid)
{
    const size_t words = f->rows.words;
    uint64_t beyond = UINT64_C(1) << 63, off = ~f->rows.last; /* reached: the cell above the word, and bits that are no cells */
    size_t inside = 0;
    for (size_t w = words; w-- > 0;) {
        const uint64_t before = solid[w], left = before & ~occupied[w];
        uint64_t reached = ~(before | occupied[w]) | off;
        const uint64_t seeds = left & (reached >> 1 | beyond);
        if (seeds) {
            reached |= spread_down(seeds, left);
            solid[w] = before & ~reached;
        }
        inside += tribox_count_most(left & ~reached);
        beyond = reached << 63;
        off = 0;
    }
    return inside;
}

/* Whether a row has a free cell beside a reached one of `from`: if so it is noted. */
static bool is_noted(const flood *f, const uint64_t *from, size_t row)
{
    const uint64_t *const occupied = occupied_row(f, row), *const solid = solid_row(f, row);
    uint64_t is_new = 0;
    for (size_t w = 0; w < f->rows.words; w++)
        is_new |= ~from[w] & solid[w] & ~occupied[w];
    if (is_new)
        f->noted[row / 64] |= UINT64_C(1) << row % 64;
    return is_new;
}

/* The rows around row j of layer k that were started. */
static void note_beside(flood *f, size_t j, size_t k)
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

/* A row for the first time: from its ends, from the rows before it on both axes, and at the border of the grid from all around. */
static void start_row(flood *f, size_t j, size_t k)
{
    const size_t words = f->rows.words, row = k * f->lines + j;
    const bool is_border = j == 0 || k == 0 || j + 1 == f->lines || k == f->last_layer;
    const uint64_t *const occupied = occupied_row(f, row);
    uint64_t *const solid = solid_row(f, row);
    const uint64_t *const below = is_border ? solid : solid - words, *const behind = is_border ? solid : solid - f->lines * words;
    uint64_t before = 1; /* reached: the cell below the word */
    for (size_t w = 0; w < words; w++) {
        const uint64_t mask = tribox_row_mask(&f->rows, w), is_free = ~occupied[w] & mask;
        const uint64_t beside = is_border ? is_free : ~(below[w] & behind[w]);
        uint64_t reached = spread_up(is_free & beside, is_free);
        if (before & is_free & ~reached) /* seldom: words do not wait for each other */
            reached |= spread_up(before, is_free);
        solid[w] = mask & ~reached;
        before = reached >> 63;
    }
    f->inside += spread_row_down(f, occupied, solid);
    if (j)
        is_noted(f, solid, row - 1);
    if (k && is_noted(f, solid, row - f->lines))
        extend(&f->next, k - 1);
}

/* A row that was noted: from the rows beside it. */
static void take_row(flood *f, size_t j, size_t k)
{
    const size_t words = f->rows.words, row = k * f->lines + j, layer = f->lines * words;
    const uint64_t *const occupied = occupied_row(f, row);
    uint64_t *const solid = solid_row(f, row);
    const uint64_t *const at[4] = {j ? solid - words : solid, j + 1 < f->lines ? solid + words : solid, k ? solid - layer : solid,
                                   k + 1 < f->layers ? solid + layer : solid};
    uint64_t before = 0;
    size_t was = 0;
    f->noted[row / 64] &= ~(UINT64_C(1) << row % 64);
    for (size_t w = 0; w < words; w++) {
        const uint64_t left = solid[w] & ~occupied[w], beside = ~(at[0][w] & at[1][w] & at[2][w] & at[3][w]);
        const uint64_t reached = spread_up(left & (beside | before), left);
        was += tribox_count_most(left);
        solid[w] &= ~reached;
        before = reached >> 63;
    }
    f->inside -= was - spread_row_down(f, occupied, solid);
    note_beside(f, j, k);
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

tribox_status tribox_fill_outside(const uint32_t size[3], const uint64_t *occupied, uint64_t *solid, void *scratch, size_t *inside)
{
    if (!size || !occupied || !solid || !scratch)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_fill_is_served(size))
        return TRIBOX_BAD_GRID;
    flood f = {.rows = tribox_rows_of(size), .lines = size[1], .last_layer = size[2] - 1, .occupied = occupied, .solid = solid};
    f.noted = tribox_fill_row_bits(scratch, &f.rows);
    f.now = f.next = none;
    start_layers(&f);
    while (f.next.from <= f.next.to)
        take_layers(&f);
    if (inside)
        *inside = f.inside;
    return TRIBOX_OK;
}
