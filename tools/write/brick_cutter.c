/* brick_cutter.c - cuts bricks eight at a time, as many as there are in a row of words. */
#include "brick_cutter.h"

#include <stdbool.h>

#include "console/message.h"

enum { SIDE = 8 };

/* The words of 64 x 8 x 8 cells: eight bricks side by side. Rows and layers beyond the grid are 0. */
typedef struct beam {
    uint64_t word[SIDE][SIDE]; /* of layer k and row j */
} beam;

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

/* layers: the words of up to eight layers from their first row on. Returns whether a cell is set. */
static bool read_beam(const uint64_t *const layers[SIDE], uint32_t depth, uint32_t rows, size_t row_words, beam *b)
{
    uint64_t any = 0;
    *b = (beam){.word = {{0}}};
    for (uint32_t k = 0; k < depth; k++)
        for (uint32_t j = 0; j < rows; j++)
            any |= b->word[k][j] = layers[k][j * row_words];
    return any != 0;
}

/* Brick i of the beam. Returns whether a cell is set. */
static bool cut(const beam *b, int i, uint64_t bits[SIDE])
{
    uint64_t any = 0;
    for (int k = 0; k < SIDE; k++) {
        bits[k] = 0;
        for (int j = 0; j < SIDE; j++)
            bits[k] |= (b->word[k][j] >> SIDE * i & 0xff) << SIDE * j;
        any |= bits[k];
    }
    return any != 0;
}

static int take_beam(const beam *b, const uint32_t first[3], brick_taker *take, void *data)
{
    uint64_t bits[SIDE];
    int code = EXIT_CODE_OK;
    for (int i = 0; i < SIDE && !code; i++) {
        const uint32_t at[3] = {first[0] + (uint32_t)i, first[1], first[2]};
        if (cut(b, i, bits))
            code = take(data, at, bits);
    }
    return code;
}

/* The bricks of eight rows in eight layers. */
static int cut_rows(const voxels *v, const uint64_t *const layers[SIDE], uint32_t depth, uint32_t y, uint32_t z, brick_taker *take,
                    void *data)
{
    const size_t row_words = voxels_row_words(&v->grid);
    const uint32_t rows = least(SIDE, v->grid.size[1] - SIDE * y);
    const uint64_t *from[SIDE] = {NULL};
    int code = EXIT_CODE_OK;
    for (size_t w = 0; w < row_words && !code; w++) {
        beam b;
        for (uint32_t k = 0; k < depth; k++)
            from[k] = layers[k] + SIDE * y * row_words + w;
        if (read_beam(from, depth, rows, row_words, &b))
            code = take_beam(&b, (const uint32_t[3]){SIDE * (uint32_t)w, y, z}, take, data);
    }
    return code;
}

int bricks_cut(const voxels *v, brick_taker *take, void *data, progress *bar)
{
    const uint32_t *const size = v->grid.size;
    const uint64_t *layers[SIDE] = {NULL};
    int code = EXIT_CODE_OK;
    for (uint32_t z = 0; z < (size[2] + SIDE - 1) / SIDE && !code; z++) {
        const uint32_t depth = least(SIDE, size[2] - SIDE * z);
        for (uint32_t k = 0; k < depth; k++)
            layers[k] = voxels_layer(v, SIDE * z + k);
        for (uint32_t y = 0; y < (size[1] + SIDE - 1) / SIDE && !code; y++)
            code = cut_rows(v, layers, depth, y, z, take, data);
        progress_tell(bar, (SIDE * z + depth) / (double)size[2]);
    }
    return code;
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
