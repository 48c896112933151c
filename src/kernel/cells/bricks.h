/*
 * bricks.h - the bricks of a window of bits, emitted to a sink. After: kernel.h. Needs: KERNEL.
 *
 * A beam is 8 x 8 rows of the window, or as many as there are at its upper borders. Most beams of a sparse window are empty.
 */
enum { BRICK = 8, BEAM_ROW_MAX = 16 };

/* The rows of a layer follow each other. */
typedef struct beam {
    uint64_t *bits;    /* of the first row */
    size_t row, layer; /* words from one to the next */
    size_t rows, layers;
} beam;

/* Words of a layer, by layers. The count of words, as an argument of its own, may be a constant. */
TRIBOX_INLINE uint64_t join_layers(const beam *b, size_t words, uint64_t joined[BRICK * BEAM_ROW_MAX])
{
    uint64_t any = 0;
    for (size_t n = 0; n < words; n++)
        joined[n] = b->bits[n];
    for (size_t k = 1; k < b->layers; k++)
        for (size_t n = 0; n < words; n++)
            joined[n] |= b->bits[k * b->layer + n];
    for (size_t n = 0; n < words; n++)
        any |= joined[n];
    return any;
}

/* The bits of a row that are set in any row; whether there are any. */
TRIBOX_INLINE bool join_rows(const beam *b, uint64_t any[BEAM_ROW_MAX])
{
    enum { USUAL = BRICK * 2 };
    uint64_t joined[BRICK * BEAM_ROW_MAX];
    const size_t words = b->rows * b->row;
    if (!(words == USUAL ? join_layers(b, USUAL, joined) : join_layers(b, words, joined)))
        return false;
    for (size_t w = 0; w < b->row; w++) {
        any[w] = 0;
        for (size_t j = 0; j < b->rows; j++)
            any[w] |= joined[j * b->row + w];
    }
    return true;
}

/* The upper part of a word for the lower part of another, wherever `low` has bits. */
TRIBOX_INLINE void exchange(uint64_t *a, uint64_t *b, int up, uint64_t low)
{
    const uint64_t differ = (*a >> up ^ *b) & low;
    *a ^= differ << up;
    *b ^= differ;
}

/* Byte j of word n becomes byte n of word j. */
TRIBOX_INLINE void transpose_bytes(uint64_t m[BRICK])
{
    for (int n = 0; n < 4; n++)
        exchange(&m[n], &m[n + 4], 32, UINT64_C(0x00000000ffffffff));
    for (int n = 0; n < 2; n++) {
        exchange(&m[n], &m[n + 2], 16, UINT64_C(0x0000ffff0000ffff));
        exchange(&m[n + 4], &m[n + 6], 16, UINT64_C(0x0000ffff0000ffff));
    }
    for (int n = 0; n < BRICK; n += 2)
        exchange(&m[n], &m[n + 1], 8, UINT64_C(0x00ff00ff00ff00ff));
}

/* The bricks of word w of the rows: word k of brick n is bricks[n][k]. */
TRIBOX_INLINE void cut_beam(const beam *b, size_t w, uint64_t bricks[BRICK][BRICK])
{
    memset(bricks, 0, BRICK * sizeof *bricks);
    for (size_t k = 0; k < b->layers; k++) {
        uint64_t rows[BRICK] = {0}, any = 0;
        for (size_t j = 0; j < b->rows; j++)
            any |= rows[j] = b->bits[k * b->layer + j * b->row + w];
        if (!any)
            continue;
        transpose_bytes(rows);
        for (int n = 0; n < BRICK; n++)
            bricks[n][k] = rows[n];
    }
}

TRIBOX_INLINE bool emit_brick(const uint64_t bits[BRICK], const uint32_t at[3], tribox_outlet *outlet)
{
    for (int k = 0; k < BRICK; k++)
        outlet->cells += tribox_count_bits(bits[k]);
    return outlet->sink.take(outlet->sink.data, at, bits) == 0;
}

/* at: the place of the beam's first brick. */
static bool emit_beam(const beam *b, const uint64_t any[BEAM_ROW_MAX], const uint32_t at[3], tribox_outlet *outlet)
{
    for (uint32_t w = 0; w < b->row; w++) {
        uint64_t bricks[BRICK][BRICK];
        if (!any[w])
            continue;
        cut_beam(b, w, bricks);
        for (uint32_t n = 0; n < BRICK; n++) {
            const uint32_t place[3] = {at[0] + BRICK * w + n, at[1], at[2]};
            if (any[w] >> BRICK * n & 0xff && !emit_brick(bricks[n], place, outlet))
                return false;
        }
    }
    return true;
}

static bool emit_bricks(uint64_t *bits, const uint32_t first[3], const uint32_t size[3], tribox_outlet *outlet)
{
    const size_t row = tribox_words_of(size[0]), layer = row * size[1];
    for (uint32_t k = 0; k < size[2]; k += BRICK)
        for (uint32_t j = 0; j < size[1]; j += BRICK) {
            const size_t rows = size[1] - j < BRICK ? size[1] - j : BRICK, layers = size[2] - k < BRICK ? size[2] - k : BRICK;
            const beam b = {bits + k * layer + j * row, row, layer, rows, layers};
            const uint32_t at[3] = {first[0] / BRICK, (first[1] + j) / BRICK, (first[2] + k) / BRICK};
            uint64_t any[BEAM_ROW_MAX];
            if (!join_rows(&b, any))
                continue;
            if (!emit_beam(&b, any, at, outlet))
                return false;
            for (size_t n = 0; n < layers; n++)
                memset(b.bits + n * layer, 0, rows * row * sizeof *bits);
        }
    return true;
}
