/*
 * voxels.c - counts cells, and tells whether there is room for them; cuts bricks eight at a time, as many as there are in a row of
 * words.
 */
#include "voxels.h"

#include <math.h>
#include <string.h>

#include "console/system.h"
#include "console/message.h"

const uint64_t *voxels_layer(const voxels *v, uint32_t k) { return v->words + k * voxels_layer_words(&v->grid); }

/* Halves change places, then quarters, and so on. */
void voxels_transpose(uint64_t words[64])
{
    uint64_t low = UINT32_MAX;
    for (unsigned half = 32; half; half /= 2, low ^= low << half)
        for (unsigned i = 0; i < 64; i = ((i | half) + 1) & ~half) {
            const uint64_t change = (words[i] >> half ^ words[i | half]) & low;
            words[i] ^= change << half;
            words[i | half] ^= change;
        }
}

/* Of so few words that no byte of the sum overflows: first pairs of bits are added, then fours, then bytes. */
static uint64_t count_few(const uint64_t *words, size_t count)
{
    const uint64_t twos = UINT64_C(0x5555555555555555), fours = UINT64_C(0x3333333333333333), bytes = UINT64_C(0x0f0f0f0f0f0f0f0f);
    uint64_t sum = 0;
    for (size_t w = 0; w < count; w++) {
        const uint64_t pairs = words[w] - (words[w] >> 1 & twos), nibbles = (pairs & fours) + (pairs >> 2 & fours);
        sum += (nibbles + (nibbles >> 4)) & bytes;
    }
    const uint64_t doubled = (sum & UINT64_C(0x00ff00ff00ff00ff)) + (sum >> 8 & UINT64_C(0x00ff00ff00ff00ff));
    return doubled * UINT64_C(0x0001000100010001) >> 48;
}

uint64_t voxels_count(const uint64_t *words, size_t count)
{
    enum { FEW = 8, WORDS_MAX = 1 << 26 }; /* the library counts up to 2^32 bits at once */
    uint64_t bits = 0;
    if (count <= FEW)
        return count_few(words, count); /* a brick, of which there are many */
    for (size_t w = 0; w < count; w += WORDS_MAX)
        bits += tribox_mask_indices(words + w, 64 * (count - w < WORDS_MAX ? count - w : WORDS_MAX), NULL);
    return bits;
}

uint64_t voxels_occupied(const voxels *v) { return voxels_count(v->words, v->grid.size[2] * voxels_layer_words(&v->grid)); }

size_t voxels_row_words(const tribox_grid *grid) { return tribox_mask_words(grid->size[0]); }

size_t voxels_layer_words(const tribox_grid *grid) { return voxels_row_words(grid) * grid->size[1]; }

bool voxels_are_shifted(const voxels *v) { return v->shift[0] != 0 || v->shift[1] != 0 || v->shift[2] != 0; }

const char *voxels_difference(const voxels *one, const voxels *other)
{
    const tribox_grid *const a = &one->grid, *const b = &other->grid;
    if (memcmp(a->origin, b->origin, sizeof a->origin) || memcmp(a->cell, b->cell, sizeof a->cell) ||
        memcmp(a->size, b->size, sizeof a->size))
        return "grid";
    return memcmp(one->shift, other->shift, sizeof one->shift) ? "shift" : NULL;
}

bool voxels_are_served(const tribox_grid *grid, const tribox_options *options)
{
    const tribox_soup nothing = {.count = 0};
    const tribox_window one = {{0, 0, 0}, {1, 1, 1}};
    uint64_t word = 0;
    return !tribox_voxelize(&nothing, grid, &one, options, &word, NULL);
}

int voxels_check_words(const tribox_grid *grid, const char *instead)
{
    static const double words_max = 0x1p31;
    char bytes[16];
    const double words = ceil(grid->size[0] / 64.0) * grid->size[1] * grid->size[2];
    if (words <= words_max)
        return EXIT_CODE_OK;
    return message_failure("a grid of %u x %u x %u cells takes %s, a bit per cell; the most is 16.0 GiB: %s", grid->size[0],
                           grid->size[1], grid->size[2], memory_text(words < 0x1p60 ? (uint64_t)(8 * words) : UINT64_MAX, bytes),
                           instead);
}

int voxels_check_memory(const tribox_grid *grid, uint64_t bytes, const char *instead)
{
    char needed[16], there[16];
    const uint64_t available = memory_available();
    if (bytes <= available)
        return EXIT_CODE_OK;
    return message_failure("%u x %u x %u cells take %s of memory here and %s are available: %s", grid->size[0], grid->size[1],
                           grid->size[2], memory_text(bytes, needed), memory_text(available, there), instead);
}

/* ----------------------------------------------------------------------------------------------------------------------- bricks */

enum { SIDE = 8 };

/* The words of 64 x 8 x 8 cells: eight bricks side by side. Rows and layers beyond the grid are 0. */
typedef struct rod {
    uint64_t word[SIDE][SIDE]; /* of layer k and row j */
} rod;

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

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

/* The bricks of a rod whose cells are set in `any`, a byte for each. */
static int take_rod(rod *b, uint64_t any, const uint32_t first[3], brick_taker *take, void *data)
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

/* The bricks of eight rows in eight layers, of the words from one to before another. */
static int cut_rows(const voxels *v, const uint32_t words[2], uint32_t y, uint32_t z, brick_taker *take, void *data)
{
    const size_t row_words = voxels_row_words(&v->grid), layer_words = voxels_layer_words(&v->grid);
    const uint32_t rows = least(SIDE, v->grid.size[1] - SIDE * y), depth = least(SIDE, v->grid.size[2] - SIDE * z);
    const uint64_t *const corner = voxels_layer(v, SIDE * z) + SIDE * y * row_words;
    int code = EXIT_CODE_OK;
    for (uint32_t w = words[0]; w < words[1] && !code; w++) {
        rod b = {.word = {{0}}};
        uint64_t any = 0;
        for (uint32_t k = 0; k < depth; k++)
            for (uint32_t j = 0; j < rows; j++)
                any |= b.word[k][j] = corner[k * layer_words + j * row_words + w];
        if (any)
            code = take_rod(&b, any, (const uint32_t[3]){SIDE * w, y, z}, take, data);
    }
    return code;
}

int bricks_cut(const voxels *v, uint32_t tile, brick_taker *take, void *data, progress *bar)
{
    const uint32_t *const size = v->grid.size;
    const uint32_t all[3] = {(size[0] + 63) / 64, (size[1] + SIDE - 1) / SIDE, (size[2] + SIDE - 1) / SIDE};
    const uint32_t step[3] = {tile ? tile / 64 : all[0], tile ? tile / SIDE : all[1], tile ? tile / SIDE : 1};
    uint32_t at[3];
    int code = EXIT_CODE_OK;
    for (at[2] = 0; at[2] < all[2] && !code; at[2] += step[2]) {
        const uint32_t z_end = least(at[2] + step[2], all[2]);
        for (at[1] = 0; at[1] < all[1]; at[1] += step[1])
            for (at[0] = 0; at[0] < all[0]; at[0] += step[0])
                for (uint32_t z = at[2]; z < z_end; z++)
                    for (uint32_t y = at[1]; y < least(at[1] + step[1], all[1]) && !code; y++)
                        code = cut_rows(v, (const uint32_t[]){at[0], least(at[0] + step[0], all[0])}, y, z, take, data);
        progress_tell(bar, z_end / (double)all[2]);
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
        const size_t layer = (SIDE * at[2] + k) * voxels_layer_words(&v->grid);
        const uint64_t *word = v->inside + layer + SIDE * at[1] * row_words + at[0] / SIDE;
        for (uint32_t j = 0; j < rows; j++, word += row_words)
            inside[k] |= (*word >> SIDE * (at[0] % SIDE) & 0xff) << SIDE * j;
    }
}

/* Eight cells along x never lie in two words. */
void bricks_lay(const uint32_t size[3], uint64_t *words, const uint32_t at[3], const uint64_t bits[8])
{
    const size_t row_words = tribox_mask_words(size[0]), layer_words = row_words * size[1];
    const uint32_t rows = least(SIDE, size[1] - SIDE * at[1]), depth = least(SIDE, size[2] - SIDE * at[2]);
    const uint32_t shift = SIDE * at[0] % 64;
    uint64_t *const corner = words + SIDE * at[2] * layer_words + SIDE * at[1] * row_words + at[0] / SIDE;
    for (uint32_t k = 0; k < depth; k++)
        for (uint32_t j = 0; j < rows; j++)
            corner[k * layer_words + j * row_words] |= (bits[k] >> SIDE * j & 0xff) << shift;
}
