/* tile_cells.c - bricks into the words of tiles, and out of them, eight at a time. */
#include "tile_cells.h"

#include <string.h>

enum { SIDE = 8 };

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

tribox_window tile_cells_of(const tile_set *set, size_t t)
{
    const uint32_t *const size = set->task.grid.size;
    tribox_window w;
    for (int a = 0; a < 3; a++) {
        const uint32_t along = size[a] / set->tile + (size[a] % set->tile != 0);
        w.first[a] = (uint32_t)(t % along) * set->tile;
        w.size[a] = least(set->tile, size[a] - w.first[a]);
        t /= along;
    }
    return w;
}

static int lay_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    (void)ids;
    const tile_words *const t = data;
    const uint32_t *const size = t->window.size;
    const size_t row_words = tribox_mask_words(size[0]);
    uint32_t from[3];
    for (int a = 0; a < 3; a++)
        from[a] = SIDE * at[a] - t->window.first[a];
    for (uint32_t k = 0; k < least(SIDE, size[2] - from[2]); k++)
        for (uint32_t j = 0; j < least(SIDE, size[1] - from[1]); j++)
            t->words[((size_t)(from[2] + k) * size[1] + from[1] + j) * row_words + from[0] / 64] |= (bits[k] >> SIDE * j & 0xff)
                                                                                                    << from[0] % 64;
    return 0;
}

tribox_status tile_words_take(const tile_set *set, size_t from, size_t to, tile_room *room, tile_words *to_words,
                              tribox_report *report)
{
    memset(to_words->words, 0, tribox_window_words(to_words->window.size) * sizeof *to_words->words);
    return tile_set_run(set, from, to, room, &(tile_sink){lay_brick, to_words}, report);
}

/* The words of 64 x 8 x 8 cells: eight bricks side by side. Rows and layers beyond the cells are 0. */
typedef struct brick_row {
    uint64_t word[SIDE][SIDE]; /* of layer k and row j */
    uint64_t any, all;         /* bits of any word, and of all of them */
} brick_row;

static void read_words(const tile_cells *c, const uint64_t *words, size_t w, uint32_t j, uint32_t k, brick_row *b)
{
    const uint32_t rows = least(SIDE, c->size[1] - j), layers = least(SIDE, c->size[2] - k);
    memset(b, 0, sizeof *b);
    b->all = rows == SIDE && layers == SIDE ? ~UINT64_C(0) : 0;
    for (uint32_t z = 0; z < layers; z++)
        for (uint32_t y = 0; y < rows; y++) {
            b->word[z][y] = words ? words[((size_t)(k + z) * c->size[1] + j + y) * c->row_words + w] : ~UINT64_C(0);
            b->any |= b->word[z][y];
            b->all &= b->word[z][y];
        }
}

/* The cells from bit `from` on, up to eight. */
static bool cut_brick(const brick_row *b, uint32_t from, uint32_t cells, uint64_t bits[SIDE])
{
    const uint64_t mask = cells < SIDE ? (UINT64_C(1) << cells) - 1 : 0xff;
    uint64_t any = 0;
    if ((b->all >> from & mask) == 0xff) {
        memset(bits, 0xff, SIDE * sizeof *bits);
        return true;
    }
    for (int z = 0; z < SIDE; z++) {
        bits[z] = 0;
        for (int y = 0; y < SIDE; y++)
            bits[z] |= (b->word[z][y] >> from & mask) << SIDE * y;
        any |= bits[z];
    }
    return any != 0;
}

/* The bricks of eight rows in eight layers. */
static int cut_rows(const tile_cells *c, uint32_t j, uint32_t k, const filled_sink *sink, uint64_t *bricks)
{
    brick_row b = {.any = 0}, of_inside = {.any = 0};
    for (uint32_t i = 0; i < c->size[0]; i += SIDE) {
        const uint32_t at[3] = {(c->first[0] + i) / SIDE, (c->first[1] + j) / SIDE, (c->first[2] + k) / SIDE};
        const uint32_t bit = c->shift + i;
        uint64_t bits[SIDE], inside[SIDE];
        if (!i || bit % 64 == 0) {
            read_words(c, c->words, bit / 64, j, k, &b);
            if (c->inside)
                read_words(c, c->inside, bit / 64, j, k, &of_inside);
        }
        if (!b.any || !cut_brick(&b, bit % 64, c->size[0] - i, bits))
            continue;
        ++*bricks;
        if (sink && c->inside)
            cut_brick(&of_inside, bit % 64, c->size[0] - i, inside);
        if (sink && sink->take(sink->data, at, bits, c->inside ? inside : bits))
            return 1;
    }
    return 0;
}

int tile_cells_cut(const tile_cells *cells, const filled_sink *sink, uint64_t *bricks)
{
    int code = 0;
    for (uint32_t k = 0; k < cells->size[2] && !code; k += SIDE)
        for (uint32_t j = 0; j < cells->size[1] && !code; j += SIDE)
            code = cut_rows(cells, j, k, sink, bricks);
    return code;
}
