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
    /* Scratch is at any address, and no byte past what was asked for is written. */
    const size_t after = random_below(r, 8);
    const int any = random_int(r, 256);
    guarded scratch_pages = guarded_make(scratch_bytes + after);
    unsigned char *const scratch = guarded_tail(scratch_pages, scratch_bytes + after);
    memset(scratch_pages.first, any, scratch_pages.size);
    memset(solid.word, random_int(r, 256), solid.bytes);
    set_walls(r, &drawn, occupied);
    guarded_read_only(occupied.pages, true);
    assert_int_equal(tribox_fill_outside(drawn.size, occupied.word, scratch, solid.word, random_int(r, 4) ? &inside : NULL),
                     TRIBOX_OK);
    for (size_t n = 0; n < after; n++)
        assert_int_equal(scratch[scratch_bytes + n], any);
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

PROGRAM(RUN(test_walls))
