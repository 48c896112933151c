/* fill_outside.c - what a surface encloses: the outside spreads through free cells, the rest is solid. */
#include "fill.h"

#include "grid_cells.h"

tribox_rows tribox_rows_of(const uint32_t size[3])
{
    return (tribox_rows){.words = tribox_words_of(size[0]),
                         .count = (size_t)size[1] * size[2],
                         .last = ~UINT64_C(0) >> (64 - (size[0] - 1) % 64 - 1)};
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

typedef struct flood {
    tribox_rows rows;
    size_t lines, layers; /* rows of a layer, and layers */
    const uint64_t *occupied;
    uint64_t *solid; /* what is not reached */
} flood;

/* The outside beside word w of a row: reached cells of the four rows around it, and all that lies outside the grid. */
static uint64_t seeds(const flood *f, size_t j, size_t k, size_t w)
{
    const size_t words = f->rows.words, at = (k * f->lines + j) * words + w;
    uint64_t seed = ~f->solid[at];
    seed |= j == 0 || k == 0 || j + 1 == f->lines || k + 1 == f->layers ? ~UINT64_C(0) : 0;
    seed |= w == 0 ? 1 : 0;
    seed |= w + 1 == words ? f->rows.last & ~(f->rows.last >> 1) : 0;
    seed |= j ? ~f->solid[at - words] : 0;
    seed |= j + 1 < f->lines ? ~f->solid[at + words] : 0;
    seed |= k ? ~f->solid[at - f->lines * words] : 0;
    seed |= k + 1 < f->layers ? ~f->solid[at + f->lines * words] : 0;
    return seed;
}

/* All free bits that touch a seed through free bits. */
static uint64_t spread(uint64_t seed, uint64_t is_free)
{
    uint64_t up = is_free, down = is_free, from_below = seed, from_above = seed;
    for (int step = 1; step < 64; step *= 2) {
        from_below |= up & from_below << step;
        up &= up << step;
        from_above |= down & from_above >> step;
        down &= down >> step;
    }
    return from_below | from_above;
}

static bool visit(const flood *f, size_t j, size_t k)
{
    const size_t words = f->rows.words;
    const uint64_t *const occupied = f->occupied + (k * f->lines + j) * words;
    uint64_t *const solid = f->solid + (k * f->lines + j) * words;
    bool is_new = false;
    for (size_t step = 0; step < 2 * words; step++) { /* upwards, then downwards */
        const size_t w = step < words ? step : 2 * words - 1 - step;
        const uint64_t is_free = ~occupied[w] & tribox_row_mask(&f->rows, w);
        uint64_t seed = seeds(f, j, k, w);
        seed |= w ? ~solid[w - 1] >> 63 : 0;
        seed |= w + 1 < words ? ~solid[w + 1] << 63 : 0;
        const uint64_t reached = spread(seed & is_free, is_free);
        is_new = is_new || reached & solid[w];
        solid[w] &= ~reached;
    }
    return is_new;
}

tribox_status tribox_fill_outside(const uint32_t size[3], const uint64_t *occupied, uint64_t *solid, void *scratch, size_t *inside)
{
    if (!size || !occupied || !solid || !scratch)
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_fill_is_served(size))
        return TRIBOX_BAD_GRID;
    const flood f = {tribox_rows_of(size), size[1], size[2], occupied, solid};
    const size_t all = f.rows.count * f.rows.words;
    memset(solid, 255, all * sizeof *solid);
    for (bool is_new = true; is_new;) {
        is_new = false;
        for (size_t r = 0; r < f.rows.count; r++)
            is_new |= visit(&f, r % f.lines, r / f.lines);
        for (size_t r = f.rows.count; r-- > 0;)
            is_new |= visit(&f, r % f.lines, r / f.lines);
    }
    size_t filled = 0;
    for (size_t w = 0; w < all; w++) {
        solid[w] &= tribox_row_mask(&f.rows, w % f.rows.words);
        filled += tribox_count_bits(solid[w] & ~occupied[w]);
    }
    if (inside)
        *inside = filled;
    return TRIBOX_OK;
}
