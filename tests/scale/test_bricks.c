/*
 * test_bricks.c - bricks have the bits of the dense grid, each once and in order, in float and double: whole, in shares, by
 * threads, in any environment, and up to where the sink ends the call.
 */
#define _POSIX_C_SOURCE 200809L
#include "brick_book.h"

#include <pthread.h>

#include "common/harness.h"
#include "common/float_environment.h"

enum { PAIRS = 100000, ROUNDS = 600, FEW_ROUNDS = 100 };

static tile_case drawn;
static uint64_t expected[CASE_WORDS], occupied[CASE_WORDS], other[CASE_WORDS];

static const uint32_t tiles[] = {8, 16, 24, 64, 128, 1024};

enum { TILES = sizeof tiles / sizeof tiles[0] };

/* Returns memory for the calls of this round, with nothing behind it, as the round before with such tiles has left it. */
static void *draw(random_source *r, size_t round)
{
    static guarded scratch[TILES];
    guarded *const pages = &scratch[round % TILES];
    tile_case_draw(r, tiles[round % TILES], &drawn);
    tile_case_tell(&drawn, doing, sizeof doing);
    if (!pages->first)
        *pages = guarded_make(tribox_bricks_bytes(drawn.tile));
    return guarded_tail(*pages, tribox_bricks_bytes(drawn.tile));
}

/* The bricks of a share into `to`; the cells that the report counts. */
static size_t take_share(const tile_case *c, size_t from, size_t to, const tile_lists *lists, void *bytes, uint64_t *occupied_by)
{
    brick_book book = brick_book_open(c, occupied_by);
    tribox_report report = {0, 0};
    assert_int_equal(
        tile_case_bricks(c, from, to, lists->starts + from, lists->list, bytes, &(tribox_sink){brick_book_take, &book}, &report),
        TRIBOX_OK);
    assert_int_equal(report.overlapping, book.cells);
    return book.cells;
}

/* EXACT has all bits of the dense grid, CONSERVATIVE at least these; FAST may differ within rounding. */
static void check_bits(const tile_case *c)
{
    if (c->options.accuracy == TRIBOX_EXACT && memcmp(occupied, expected, sizeof occupied))
        fail_msg("%s: the bits are not those of the dense grid", doing);
    for (size_t w = 0; w < CASE_WORDS && c->options.accuracy == TRIBOX_CONSERVATIVE; w++)
        assert_true((expected[w] & ~occupied[w]) == 0);
}

static void expect_dense(const tile_case *c)
{
    const tribox_options exact = {.axes = c->options.axes, .kernel = "scalar"};
    tile_case_dense(c, &exact, expected);
}

CASE(test_dense)
{
    random_source r = random_named(args.seed, "bricks");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        void *const scratch = draw(&r, round);
        const size_t count = tile_case_tiles(&drawn);
        const tile_lists lists = tile_case_lists(&drawn, 0, count);
        size_t sum = 0;
        expect_dense(&drawn);
        memset(occupied, 0, sizeof occupied);
        const size_t cells = take_share(&drawn, 0, count, &lists, scratch, occupied);
        check_bits(&drawn);
        memset(other, 0, sizeof other);
        for (size_t from = 0, to; from < count; from = to) {
            to = from + 1 + (size_t)random_int(&r, (int)(count - from));
            sum += take_share(&drawn, from, to, &lists, scratch, other);
        }
        assert_int_equal(sum, cells);
        assert_memory_equal(other, occupied, sizeof other);
        tile_lists_free(lists);
    }
}

/* A sink that ends the call after any number of bricks, of all there are as well. */
CASE(test_stops)
{
    random_source r = random_named(args.seed, "stops");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / FEW_ROUNDS); round++) {
        void *const scratch = draw(&r, round);
        const size_t count = tile_case_tiles(&drawn);
        const tile_lists lists = tile_case_lists(&drawn, 0, count);
        brick_book whole = brick_book_open(&drawn, NULL), book = whole;
        tribox_report report = {0, 0};
        assert_int_equal(
            tile_case_bricks(&drawn, 0, count, lists.starts, lists.list, scratch, &(tribox_sink){brick_book_take, &whole}, &report),
            TRIBOX_OK);
        if (whole.bricks) {
            book.most = 1 + (size_t)random_int(&r, (int)whole.bricks);
            assert_int_equal(tile_case_bricks(&drawn, 0, count, lists.starts, lists.list, scratch,
                                              &(tribox_sink){brick_book_take, &book}, &report),
                             TRIBOX_STOPPED);
            assert_int_equal(book.bricks, book.most);
            assert_int_equal(report.overlapping, book.cells);
        }
        tile_lists_free(lists);
    }
}

/* Any rounding, flushes and traps: the same bits, and the sink runs in what the caller has set. */
CASE(test_environment)
{
    const unsigned normal = environment_get();
    random_source r = random_named(args.seed, "environment");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / FEW_ROUNDS); round++) {
        void *const scratch = draw(&r, round);
        const size_t count = tile_case_tiles(&drawn);
        const tile_lists lists = tile_case_lists(&drawn, 0, count);
        memset(expected, 0, sizeof expected);
        take_share(&drawn, 0, count, &lists, scratch, expected);
        const unsigned set = setting((unsigned)random_int(&r, SETTINGS));
        brick_book book = brick_book_open(&drawn, occupied);
        tribox_report report = {0, 0};
        book.environment = set;
        memset(occupied, 0, sizeof occupied);
        environment_set(set);
        const tribox_status counted = tile_case_count(&drawn, 0, count, lists.starts);
        const tribox_status status =
            tile_case_bricks(&drawn, 0, count, lists.starts, lists.list, scratch, &(tribox_sink){brick_book_take, &book}, &report);
        const unsigned left = environment_get();
        environment_set(normal);
        assert_int_equal(counted, TRIBOX_OK);
        assert_int_equal(status, TRIBOX_OK);
        assert_int_equal(left, set);
        assert_memory_equal(occupied, expected, sizeof occupied);
        tile_lists_free(lists);
    }
}

typedef struct worker {
    pthread_t thread;
    size_t from, to;
    tile_lists lists;
    uint64_t *occupied;
} worker;

/* A thread makes the lists of its share, and its bricks. */
static void *work(void *argument)
{
    worker *const w = argument;
    void *const bytes = malloc(tribox_bricks_bytes(drawn.tile));
    brick_book book = brick_book_open(&drawn, w->occupied);
    w->lists = tile_case_lists(&drawn, w->from, w->to);
    assert_non_null(bytes);
    assert_int_equal(tile_case_bricks(&drawn, w->from, w->to, w->lists.starts, w->lists.list, bytes,
                                      &(tribox_sink){brick_book_take, &book}, NULL),
                     TRIBOX_OK);
    free(bytes);
    return NULL;
}

CASE(test_threads)
{
    random_source r = random_named(args.seed, "threads");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / FEW_ROUNDS); round++) {
        draw(&r, round);
        const size_t count = tile_case_tiles(&drawn), middle = (size_t)random_int(&r, (int)count + 1);
        worker workers[2] = {{.from = 0, .to = middle, .occupied = occupied}, {.from = middle, .to = count, .occupied = other}};
        expect_dense(&drawn);
        memset(occupied, 0, sizeof occupied);
        memset(other, 0, sizeof other);
        for (int t = 0; t < 2; t++)
            assert_int_equal(pthread_create(&workers[t].thread, NULL, work, &workers[t]), 0);
        for (int t = 0; t < 2; t++) {
            assert_int_equal(pthread_join(workers[t].thread, NULL), 0);
            tile_lists_free(workers[t].lists);
        }
        for (size_t w = 0; w < CASE_WORDS; w++) {
            assert_true((occupied[w] & other[w]) == 0);
            occupied[w] |= other[w];
        }
        check_bits(&drawn);
    }
}

PROGRAM(RUN(test_dense), RUN(test_stops), RUN(test_environment), RUN(test_threads))
