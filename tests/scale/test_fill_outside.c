/* test_fill_outside.c - what is filled are the cells that a plain search from outside does not find, whatever the walls. */
#include "common/harness.h"
#include "fill_search.h"
#include "fill_walls.h"

enum { PAIRS = 100000, ROUNDS = 1500 };

static walls drawn;
static unsigned char is_reached[WALLS_CELLS];

/* Words of a grid between pages that cannot be touched. */
typedef struct grid_words {
    guarded pages;
    uint64_t *word;
    size_t row, bytes;
} grid_words;

static grid_words words_make(const walls *w)
{
    grid_words g = {.row = (w->size[0] + 63) / 64};
    g.bytes = g.row * w->size[1] * w->size[2] * sizeof *g.word;
    g.pages = guarded_make(g.bytes);
    g.word = guarded_tail(g.pages, g.bytes);
    return g;
}

/* With bits of any kind past the end of each row. */
static void set_walls(random_source *r, const walls *w, grid_words g)
{
    for (size_t row = 0; row < (size_t)w->size[1] * w->size[2]; row++)
        for (uint32_t i = 0; i < 64 * g.row; i++) {
            const uint64_t is = i < w->size[0] ? w->is_wall[row * w->size[0] + i] : (uint64_t)random_int(r, 2);
            uint64_t *const word = &g.word[row * g.row + i / 64];
            *word = (*word & ~(UINT64_C(1) << i % 64)) | is << i % 64;
        }
}

static void check_words(const walls *w, grid_words solid)
{
    for (size_t row = 0; row < (size_t)w->size[1] * w->size[2]; row++)
        for (uint32_t i = 0; i < 64 * solid.row; i++) {
            const bool is = solid.word[row * solid.row + i / 64] >> i % 64 & 1;
            if (is != (i < w->size[0] && !is_reached[row * w->size[0] + i]))
                fail_msg("%s: cell %u of row %zu is %s", doing, i, row, is ? "filled" : "not filled");
        }
}

static void check_drawn(random_source *r)
{
    const size_t reached = fill_search(&drawn, is_reached), scratch_bytes = tribox_fill_bytes(drawn.size);
    size_t free_cells = 0, inside = SIZE_MAX;
    for (size_t n = 0; n < (size_t)drawn.size[0] * drawn.size[1] * drawn.size[2]; n++)
        free_cells += !drawn.is_wall[n];
    grid_words occupied = words_make(&drawn), solid = words_make(&drawn);
    guarded scratch_pages = guarded_make(scratch_bytes);
    memset(scratch_pages.first, random_int(r, 256), scratch_pages.size);
    memset(solid.word, random_int(r, 256), solid.bytes);
    set_walls(r, &drawn, occupied);
    guarded_read_only(occupied.pages, true);
    void *const scratch = random_int(r, 2) ? guarded_tail(scratch_pages, scratch_bytes) : (void *)scratch_pages.first;
    assert_int_equal(tribox_fill_outside(drawn.size, occupied.word, scratch, solid.word, random_int(r, 4) ? &inside : NULL),
                     TRIBOX_OK);
    check_words(&drawn, solid);
    if (inside != SIZE_MAX && inside != free_cells - reached)
        fail_msg("%s: %zu are inside, not %zu", doing, free_cells - reached, inside);
    guarded_free(occupied.pages);
    guarded_free(solid.pages);
    guarded_free(scratch_pages);
}

CASE(test_walls)
{
    random_source r = random_named(args.seed, "fill outside");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 10 : 1); round++) {
        walls_draw(&r, round % walls_kinds(), &drawn);
        snprintf(doing, sizeof doing, "round %zu, %s in %u x %u x %u", round, drawn.kind, drawn.size[0], drawn.size[1],
                 drawn.size[2]);
        check_drawn(&r);
    }
}

/* Scratch is at any address, and no byte past what was asked for is written. */
CASE(test_scratch)
{
    static const uint32_t sizes[][3] = {{1, 1, 1}, {70, 8, 8}, {3, 64, 1}, {3, 1, 65}, {3, 13, 11}};
    for (size_t n = 0; n < sizeof sizes / sizeof sizes[0]; n++)
        for (size_t off = 0; off < 9; off++) {
            const uint64_t occupied[256] = {0};
            uint64_t solid[256];
            unsigned char scratch[256];
            const size_t bytes = tribox_fill_bytes(sizes[n]);
            assert_true(bytes + off + 8 < sizeof scratch);
            memset(scratch, 0x5a, sizeof scratch);
            assert_int_equal(tribox_fill_outside(sizes[n], occupied, scratch + off, solid, NULL), TRIBOX_OK);
            for (size_t at = 0; at < sizeof scratch; at++)
                assert_true((at >= off && at < off + bytes) || scratch[at] == 0x5a);
        }
}

CASE(test_bytes)
{
    const uint32_t most[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX}, cube[3] = {1024, 1024, 1024}, none[3] = {0, 0, 0};
    assert_true(tribox_fill_bytes(cube) <= 1024 * 1024 / 4 + 64);
    assert_true(tribox_fill_bytes(none) <= 64);
    if (sizeof(size_t) == 4)
        assert_true(tribox_fill_bytes(most) == SIZE_MAX);
    else
        assert_true(tribox_fill_bytes(most) >= SIZE_MAX / 16);
}

static void check_refused(tribox_status expected, const uint32_t *size, const uint64_t *occupied, uint64_t *solid, void *scratch)
{
    size_t inside = 123;
    uint64_t words[8];
    unsigned char bytes[64];
    memset(words, 0xa5, sizeof words);
    memset(bytes, 0xa5, sizeof bytes);
    assert_int_equal(tribox_fill_outside(size, occupied, scratch ? bytes : NULL, solid ? words : NULL, &inside), expected);
    assert_int_equal(inside, 123);
    for (size_t n = 0; n < sizeof bytes; n++)
        assert_true(bytes[n] == 0xa5 && ((unsigned char *)words)[n] == 0xa5);
}

CASE(test_bad_arguments)
{
    const uint32_t size[3] = {9, 3, 2};
    uint64_t some[8] = {0};
    check_refused(TRIBOX_BAD_ARGUMENT, NULL, some, some, some);
    check_refused(TRIBOX_BAD_ARGUMENT, size, NULL, some, some);
    check_refused(TRIBOX_BAD_ARGUMENT, size, some, NULL, some);
    check_refused(TRIBOX_BAD_ARGUMENT, size, some, some, NULL);
    for (int a = 0; a < 3; a++) {
        uint32_t wrong[3] = {9, 3, 2};
        wrong[a] = 0;
        check_refused(TRIBOX_BAD_GRID, wrong, some, some, some);
    }
    check_refused(TRIBOX_BAD_GRID, (uint32_t[3]){65, UINT32_MAX, 1}, some, some, some);
    check_refused(TRIBOX_BAD_GRID, (uint32_t[3]){1, UINT32_MAX, UINT32_MAX}, some, some, some);
    check_refused(TRIBOX_BAD_GRID, (uint32_t[3]){UINT32_MAX, UINT32_MAX, UINT32_MAX}, some, some, some);
}

PROGRAM(RUN(test_walls), RUN(test_scratch), RUN(test_bytes), RUN(test_bad_arguments))
