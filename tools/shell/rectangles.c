/* rectangles.c - masks of faces by words of 64, and rectangles out of them. */
#include "rectangles.h"

#include <string.h>

#include "colours/cell_colours.h"
#include "write/lowest_bit.h"

enum { SIDE = 64 };

typedef struct walk {
    const voxels *cells;
    uint64_t *mask;
    void (*take)(void *data, const rectangle *r);
    bool (*tell)(void *data, double done);
    void *data;
} walk;

static size_t words_of(uint32_t bits) { return tribox_mask_words(bits); }

uint64_t rectangles_words(const tribox_grid *grid)
{
    const uint64_t row = words_of(grid->size[0]), y = grid->size[1], z = grid->size[2];
    const uint64_t across_x = SIDE * z * words_of(grid->size[1]), across_z = row * (y > z ? y : z);
    return across_x > across_z ? across_x : across_z;
}

/* The bits from `from` of word w on, to `to` at most; both count from the start of the row. */
static uint64_t bits_of_word(size_t w, uint32_t from, uint32_t to)
{
    const uint64_t start = 64 * (uint64_t)w, above = from > start ? ~UINT64_C(0) << (from - start) : ~UINT64_C(0);
    return to - start >= 64 ? above : above & ~(~UINT64_C(0) << (to - start));
}

/* Where the run of set bits that begins at `from` ends. */
static uint32_t end_of_run(const uint64_t *row, size_t words, uint32_t from)
{
    for (size_t w = from / 64; w < words; w++) {
        const uint64_t clear = ~row[w] & bits_of_word(w, from, UINT32_MAX);
        if (clear)
            return (uint32_t)(64 * w) + lowest_bit(clear);
    }
    return (uint32_t)(64 * words);
}

static bool has_run(const uint64_t *row, uint32_t from, uint32_t to)
{
    for (size_t w = from / 64; w <= (to - 1) / 64; w++)
        if (bits_of_word(w, from, to) & ~row[w])
            return false;
    return true;
}

static void clear_run(uint64_t *row, uint32_t from, uint32_t to)
{
    for (size_t w = from / 64; w <= (to - 1) / 64; w++)
        row[w] &= ~bits_of_word(w, from, to);
}

/* Of the cell behind a face of the rectangle's plane. */
static rgb colour_at(const walk *k, const rectangle *r, uint32_t column, uint32_t row)
{
    uint32_t cell[3];
    cell[r->axis] = r->plane - r->is_up;
    cell[rectangle_u(r->axis)] = column;
    cell[rectangle_v(r->axis)] = row;
    return cell_colours_at(k->cells->colours, cell);
}

/* Where the rectangle's colour ends in a row of it. */
static uint32_t end_of_colour(const walk *k, const rectangle *r, uint32_t row)
{
    uint32_t column = r->from[0];
    while (column < r->to[0] && rgb_number(colour_at(k, r, column, row)) == rgb_number(r->colour))
        column++;
    return column;
}

/* Takes the first run of the row, up to where it changes its colour, and as many rows after it as go on with it. */
static void cut_rectangle(const walk *k, uint64_t *mask, size_t words, uint32_t rows, rectangle *r)
{
    const uint32_t row = r->from[1];
    const bool has_colours = k->cells->colours;
    r->to[0] = end_of_run(mask + row * words, words, r->from[0]);
    if (has_colours) {
        r->colour = colour_at(k, r, r->from[0], row);
        r->to[0] = end_of_colour(k, r, row);
    }
    r->to[1] = row;
    do
        clear_run(mask + r->to[1]++ * words, r->from[0], r->to[0]);
    while (r->to[1] < rows && has_run(mask + r->to[1] * words, r->from[0], r->to[0]) &&
           (!has_colours || end_of_colour(k, r, r->to[1]) == r->to[0]));
}

/* Takes all bits of a mask; r says which plane it is. */
static void cut_mask(const walk *k, uint64_t *mask, size_t words, uint32_t rows, rectangle r)
{
    for (uint32_t j = 0; j < rows; j++) {
        uint64_t *const row = mask + j * words;
        for (size_t w = 0; w < words; w++)
            while (row[w]) {
                r.from[0] = (uint32_t)(64 * w) + lowest_bit(row[w]);
                r.from[1] = j;
                cut_rectangle(k, mask, words, rows, &r);
                k->take(k->data, &r);
            }
    }
}

/* The faces between two rows of cells, either NULL for one beyond the grid. Returns whether there are any. */
static bool faces_of_rows(const uint64_t *below, const uint64_t *above, bool is_up, size_t words, uint64_t *faces)
{
    const uint64_t *const set = is_up ? below : above, *const clear = is_up ? above : below;
    uint64_t any = 0;
    for (size_t w = 0; w < words; w++)
        any |= faces[w] = (set ? set[w] : 0) & ~(clear ? clear[w] : 0);
    return any != 0;
}

/* Across y or z: rows along x on both sides of the plane. */
static const uint64_t *row_of(const walk *k, int axis, uint32_t plane, uint32_t row)
{
    if (plane >= k->cells->grid.size[axis]) /* also one before the first, which wraps around */
        return NULL;
    return voxels_layer(k->cells, axis == 2 ? plane : row) + (axis == 2 ? row : plane) * voxels_row_words(&k->cells->grid);
}

static void cut_plane(const walk *k, int axis, uint32_t plane, bool is_up)
{
    const size_t words = voxels_row_words(&k->cells->grid);
    const uint32_t rows = k->cells->grid.size[rectangle_v(axis)];
    bool any = false;
    for (uint32_t j = 0; j < rows; j++)
        any |= faces_of_rows(row_of(k, axis, plane - 1, j), row_of(k, axis, plane, j), is_up, words, k->mask + j * words);
    if (any)
        cut_mask(k, k->mask, words, rows, (rectangle){.axis = axis, .plane = plane, .is_up = is_up});
}

/* Bit i of word j becomes bit j of word i: blocks beside the diagonal are swapped, of 32 x 32 bits, then of 16 x 16, and so on. */
static void transpose(uint64_t block[SIDE])
{
    uint64_t low = UINT64_C(0xffffffff);
    for (uint32_t n = 32; n; n /= 2, low ^= low << n)
        for (uint32_t i = 0; i < SIDE; i = (i + n + 1) & ~n) {
            const uint64_t other = (block[i] >> n ^ block[i + n]) & low;
            block[i] ^= other << n;
            block[i + n] ^= other;
        }
}

/* The faces on the planes across x from 64 w on, of a row of cells. */
static uint64_t faces_across_x(const uint64_t *row, size_t words, size_t w, bool is_up)
{
    const uint64_t above = w < words ? row[w] : 0, below = above << 1 | (w ? row[w - 1] >> 63 : 0);
    return is_up ? below & ~above : above & ~below;
}

/* Lays out 64 planes across x, each with rows along y. Returns which of them have faces. */
static uint64_t lay_planes(const walk *k, size_t w, bool is_up)
{
    const uint32_t *const n = k->cells->grid.size;
    const size_t words = voxels_row_words(&k->cells->grid), y_words = words_of(n[1]);
    uint64_t all = 0;
    memset(k->mask, 0, SIDE * y_words * n[2] * sizeof *k->mask);
    for (uint32_t z = 0; z < n[2]; z++)
        for (size_t y = 0; y < y_words; y++) {
            uint64_t block[SIDE] = {0}, any = 0;
            const uint32_t rows = n[1] - 64 * (uint32_t)y < SIDE ? n[1] - 64 * (uint32_t)y : SIDE;
            const uint64_t *const from = voxels_layer(k->cells, z) + SIDE * y * words;
            for (uint32_t j = 0; j < rows; j++)
                any |= block[j] = faces_across_x(from + j * words, words, w, is_up);
            if (any)
                transpose(block);
            for (size_t i = 0; any && i < SIDE; i++)
                k->mask[(i * n[2] + z) * y_words + y] = block[i];
            all |= any;
        }
    return all;
}

static void cut_planes_across_x(const walk *k, size_t w, bool is_up)
{
    const uint32_t *const n = k->cells->grid.size;
    const size_t y_words = words_of(n[1]);
    for (uint64_t planes = lay_planes(k, w, is_up); planes; planes &= planes - 1) {
        const uint32_t i = lowest_bit(planes);
        cut_mask(k, k->mask + i * n[2] * y_words, y_words, n[2],
                 (rectangle){.axis = 0, .plane = (uint32_t)(64 * w) + i, .is_up = is_up});
    }
}

void rectangles_walk(const voxels *v, uint64_t *mask, void (*take)(void *data, const rectangle *r),
                     bool (*tell)(void *data, double done), void *data)
{
    const walk k = {v, mask, take, tell, data};
    const size_t x_words = words_of(v->grid.size[0] + 1);
    bool is_over = false;
    for (size_t w = 0; w < x_words && !is_over; w++) {
        cut_planes_across_x(&k, w, false);
        cut_planes_across_x(&k, w, true);
        is_over = tell(data, (double)(w + 1) / (double)x_words / 3);
    }
    for (int axis = 1; axis < 3; axis++)
        for (uint32_t p = 0; p <= v->grid.size[axis] && !is_over; p++) {
            cut_plane(&k, axis, p, false);
            cut_plane(&k, axis, p, true);
            is_over = tell(data, (axis + (p + 1.0) / (v->grid.size[axis] + 1.0)) / 3);
        }
}
