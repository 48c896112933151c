/* brick_sink.c - the bricks of a window of bits. */
#include "brick_sink.h"

#include <string.h>

#include "bits.h"

enum { SIDE = 8 };

/* A column of 64 bits of up to 8 x 8 rows. */
typedef struct column {
    const uint64_t *bits; /* of its first row */
    size_t row, layer;    /* words from one to the next */
    uint32_t rows, layers;
} column;

static uint64_t any_of(const column *c)
{
    uint64_t any = 0;
    for (uint32_t k = 0; k < c->layers; k++)
        for (uint32_t j = 0; j < c->rows; j++)
            any |= c->bits[k * c->layer + j * c->row];
    return any;
}

/* The brick of byte b of the words. */
static void take_brick(const column *c, unsigned b, uint64_t bits[SIDE])
{
    memset(bits, 0, SIDE * sizeof *bits);
    for (uint32_t k = 0; k < c->layers; k++)
        for (uint32_t j = 0; j < c->rows; j++)
            bits[k] |= (c->bits[k * c->layer + j * c->row] >> 8 * b & 0xff) << 8 * j;
}

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

bool tribox_bricks_hand_on(const uint64_t *bits, const uint32_t first[3], const uint32_t size[3], tribox_hand *hand)
{
    const size_t row = tribox_mask_words(size[0]), layer = row * size[1];
    for (uint32_t k = 0; k < size[2]; k += SIDE)
        for (uint32_t j = 0; j < size[1]; j += SIDE)
            for (uint32_t w = 0; w < row; w++) {
                const column c = {bits + k * layer + j * row + w, row, layer, least(size[1] - j, SIDE), least(size[2] - k, SIDE)};
                const uint64_t any = any_of(&c);
                for (unsigned b = 0; b < SIDE; b++) {
                    const uint32_t at[3] = {first[0] / SIDE + w * SIDE + b, (first[1] + j) / SIDE, (first[2] + k) / SIDE};
                    uint64_t brick[SIDE];
                    if (!(any >> 8 * b & 0xff))
                        continue;
                    take_brick(&c, b, brick);
                    for (int n = 0; n < SIDE; n++)
                        hand->cells += (size_t)tribox_count_bits(brick[n]);
                    if (!hand->sink(hand->data, at, brick))
                        return false;
                }
            }
    return true;
}
