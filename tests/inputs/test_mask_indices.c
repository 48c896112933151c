/* test_mask_indices.c - the set bits of a mask, and the set cells of a window, in order, and no bit past the count or a row. */
#include "common/harness.h"

enum { WORDS = 200, COUNT_MAX = 64 * WORDS };
static guarded mask_fence, index_fence;

static int set_up(void)
{
    mask_fence = guarded_make(WORDS * sizeof(uint64_t));
    index_fence = guarded_make(COUNT_MAX * sizeof(uint32_t[3]));
    return 0;
}

/* Of about one bit in `spread`, from none to all; or a run of them. */
enum { NO_BITS = 0, A_RUN = -1 };
static uint64_t draw_word(random_source *r, int spread)
{
    uint64_t word = 0;
    if (spread == A_RUN)
        return ~UINT64_C(0) << random_int(r, 64) >> random_int(r, 64);
    for (int bit = 0; spread && bit < 64; bit++)
        word |= (uint64_t)(random_int(r, spread) == 0) << bit;
    return word;
}

/*
 * The bits and the room for what is set end at pages that cannot be touched. Bits past a row are as they come. A window of one row
 * is a mask, too.
 */
static void check(random_source *r, const uint32_t size[3], int spread)
{
    static uint32_t expected[COUNT_MAX][3], numbers[COUNT_MAX];
    const size_t row = tribox_mask_words(size[0]), words = tribox_window_words(size);
    uint64_t *const bits = guarded_tail(mask_fence, words * sizeof *bits);
    size_t set = 0;
    for (size_t w = 0; w < words; w++)
        bits[w] = draw_word(r, spread);
    if (size[0] % 64 && words && random_int(r, 2))
        bits[words - 1] |= ~UINT64_C(0) << size[0] % 64;
    for (uint32_t k = 0; k < size[2]; k++)
        for (uint32_t j = 0; j < size[1]; j++)
            for (uint32_t i = 0; i < size[0]; i++)
                if (bits[(k * size[1] + j) * row + i / 64] >> i % 64 & 1) {
                    numbers[set] = i;
                    memcpy(expected[set++], (const uint32_t[]){i, j, k}, sizeof *expected);
                }
    snprintf(doing, sizeof doing, "bits of %u x %u x %u, %zu of them set", size[0], size[1], size[2], set);
    uint32_t(*const cells)[3] = (uint32_t(*)[3])(void *)guarded_tail(index_fence, set * sizeof *cells);
    assert_int_equal(tribox_window_cells(bits, size, NULL), set);
    assert_int_equal(tribox_window_cells(bits, size, cells), set);
    if (set)
        assert_memory_equal(cells, expected, set * sizeof *cells);
    if (size[1] != 1 || size[2] != 1)
        return;
    uint32_t *const indices = guarded_tail(index_fence, set * sizeof *indices);
    memset(indices, 0xff, set * sizeof *indices);
    assert_int_equal(tribox_mask_indices(bits, size[0], NULL), set);
    assert_int_equal(tribox_mask_indices(bits, size[0], indices), set);
    if (set)
        assert_memory_equal(indices, numbers, set * sizeof *indices);
}

/* All bits set, none, and anything between. */
CASE(test_every_count)
{
    static const int spreads[] = {NO_BITS, 1, 2, 3, 7, 64, 300, A_RUN};
    random_source r = random_named(args.seed, "every count");
    for (size_t s = 0; s < sizeof spreads / sizeof spreads[0]; s++)
        for (uint32_t count = 0; count <= COUNT_MAX; count += count == 300 ? COUNT_MAX - 365 : 1)
            check(&r, (const uint32_t[]){count, 1, 1}, spreads[s]);
}

/* Each bit alone, and each bit alone past the count. */
CASE(test_each_bit)
{
    for (size_t bit = 0; bit < 192; bit++)
        for (size_t count = 0; count <= 192; count++) {
            uint64_t mask[3] = {0};
            uint32_t index[1] = {0xffffffffu};
            mask[bit / 64] = UINT64_C(1) << bit % 64;
            assert_int_equal(tribox_mask_indices(mask, count, NULL), bit < count);
            assert_int_equal(tribox_mask_indices(mask, count, index), bit < count);
            assert_int_equal(index[0], bit < count ? bit : 0xffffffffu);
        }
}

CASE(test_windows)
{
    random_source r = random_named(args.seed, "windows");
    for (uint32_t size = 0; size <= 200; size++)
        for (int spread = A_RUN; spread < 5; spread++)
            for (uint32_t rows = 0; rows <= 6; rows++)
                check(&r, (const uint32_t[]){size, rows, 1 + size % 6}, spread);
}

CASE(test_nothing)
{
    uint32_t index = 7;
    assert_int_equal(tribox_window_cells(NULL, (const uint32_t[]){5, 0, 5}, NULL), 0);
    assert_int_equal(tribox_mask_indices(NULL, 0, NULL), 0);
    assert_int_equal(tribox_mask_indices(NULL, 0, &index), 0);
    assert_int_equal(index, 7);
}

PROGRAM_AFTER(set_up, RUN(test_every_count), RUN(test_windows), RUN(test_each_bit), RUN(test_nothing))
