/* brick_cutter.c - cuts bricks eight at a time, as many as there are in a row of words. */
#include "brick_cutter.h"

#include "console/message.h"

enum { SIDE = 8 };

/* The words of 64 x 8 x 8 cells: eight bricks side by side. Rows and layers beyond the grid are 0. */
typedef struct beam {
    uint64_t word[SIDE][SIDE]; /* of layer k and row j */
} beam;

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

/* layers: the words of up to eight layers from their first row on. Returns the cells of all these words together. */
static uint64_t read_beam(const uint64_t *const layers[SIDE], uint32_t depth, uint32_t rows, size_t row_words, beam *b)
{
    uint64_t any = 0;
    *b = (beam){.word = {{0}}};
    for (uint32_t k = 0; k < depth; k++)
        for (uint32_t j = 0; j < rows; j++)
            any |= b->word[k][j] = layers[k][j * row_words];
    return any;
}

/* Exchanges the bytes of eight words: byte i of word j becomes byte j of word i. */
static void exchange(uint64_t word[SIDE])
{
    static const uint64_t low[] = {UINT64_C(0x00ff00ff00ff00ff), UINT64_C(0x0000ffff0000ffff), UINT64_C(0x00000000ffffffff)};
    for (int step = 0; step < 3; step++)
        for (int j = 0; j < SIDE; j++) {
            const int other = j | 1 << step, shift = SIDE << step;
            if (other == j)
                continue;
            const uint64_t a = word[j], b = word[other];
            word[j] = (a & low[step]) | (b & low[step]) << shift;
            word[other] = (a >> shift & low[step]) | (b & ~low[step]);
        }
}

/* The bricks of a beam whose cells are set in `any`, a byte for each. */
static int take_beam(beam *b, uint64_t any, const uint32_t first[3], brick_taker *take, void *data)
{
    int code = EXIT_CODE_OK;
    for (int k = 0; k < SIDE; k++)
        exchange(b->word[k]);
    for (uint32_t i = 0; i < SIDE && !code; i++) {
        uint64_t bits[SIDE];
        for (int k = 0; k < SIDE; k++)
            bits[k] = b->word[k][i];
        if (any >> SIDE * i & 0xff)
            code = take(data, (const uint32_t[3]){first[0] + i, first[1], first[2]}, bits);
    }
    return code;
}

/* A box of words: 64 cells of x, and bricks of y and z. */
typedef struct words_box {
    uint32_t first[3], end[3];
} words_box;

/* The bricks of eight rows in eight layers. */
static int cut_rows(const voxels *v, const words_box *box, uint32_t y, uint32_t z, brick_taker *take, void *data)
{
    const size_t row_words = voxels_row_words(&v->grid);
    const uint32_t rows = least(SIDE, v->grid.size[1] - SIDE * y), depth = least(SIDE, v->grid.size[2] - SIDE * z);
    const uint64_t *from[SIDE] = {NULL};
    for (uint32_t k = 0; k < depth; k++)
        from[k] = voxels_layer(v, SIDE * z + k) + SIDE * y * row_words + box->first[0];
    int code = EXIT_CODE_OK;
    for (uint32_t w = box->first[0]; w < box->end[0] && !code; w++) {
        beam b;
        const uint64_t any = read_beam(from, depth, rows, row_words, &b);
        if (any)
            code = take_beam(&b, any, (const uint32_t[3]){SIDE * w, y, z}, take, data);
        for (uint32_t k = 0; k < depth; k++)
            from[k]++;
    }
    return code;
}

static int cut_box(const voxels *v, const words_box *box, brick_taker *take, void *data)
{
    int code = EXIT_CODE_OK;
    for (uint32_t z = box->first[2]; z < box->end[2] && !code; z++)
        for (uint32_t y = box->first[1]; y < box->end[1] && !code; y++)
            code = cut_rows(v, box, y, z, take, data);
    return code;
}

int bricks_cut(const voxels *v, uint32_t tile, brick_taker *take, void *data, progress *bar)
{
    const uint32_t *const size = v->grid.size;
    const uint32_t all[3] = {(size[0] + 63) / 64, (size[1] + SIDE - 1) / SIDE, (size[2] + SIDE - 1) / SIDE};
    const uint32_t step[3] = {tile ? tile / 64 : all[0], tile ? tile / SIDE : all[1], tile ? tile / SIDE : 1};
    int code = EXIT_CODE_OK;
    for (uint32_t k = 0; k < all[2] && !code; k += step[2]) {
        for (uint32_t j = 0; j < all[1] && !code; j += step[1])
            for (uint32_t i = 0; i < all[0] && !code; i += step[0]) {
                const words_box box = {{i, j, k},
                                       {least(i + step[0], all[0]), least(j + step[1], all[1]), least(k + step[2], all[2])}};
                code = cut_box(v, &box, take, data);
            }
        progress_tell(bar, least(k + step[2], all[2]) / (double)all[2]);
    }
    return code;
}

void bricks_inside(const voxels *v, const uint32_t at[3], uint64_t inside[8])
{
    const size_t row_words = voxels_row_words(&v->grid);
    const uint32_t rows = least(SIDE, v->grid.size[1] - SIDE * at[1]), depth = least(SIDE, v->grid.size[2] - SIDE * at[2]);
    for (uint32_t k = 0; k < SIDE; k++)
        inside[k] = 0;
    for (uint32_t k = 0; k < depth; k++) {
        const uint64_t *word = voxels_layer_inside(v, SIDE * at[2] + k) + SIDE * at[1] * row_words + at[0] / SIDE;
        for (uint32_t j = 0; j < rows; j++, word += row_words)
            inside[k] |= (*word >> SIDE * (at[0] % SIDE) & 0xff) << SIDE * j;
    }
}

/* Eight cells along x never lie in two words. */
void bricks_lay(const tribox_grid *grid, uint64_t *words, const uint32_t at[3], const uint64_t bits[8])
{
    const size_t row_words = voxels_row_words(grid), layer_words = voxels_layer_words(grid);
    const uint32_t rows = least(SIDE, grid->size[1] - SIDE * at[1]), depth = least(SIDE, grid->size[2] - SIDE * at[2]);
    const uint32_t shift = SIDE * at[0] % 64;
    uint64_t *const corner = words + SIDE * at[2] * layer_words + SIDE * at[1] * row_words + at[0] / SIDE;
    for (uint32_t k = 0; k < depth; k++)
        for (uint32_t j = 0; j < rows; j++)
            corner[k * layer_words + j * row_words] |= (bits[k] >> SIDE * j & 0xff) << shift;
}
