/*
 * test_bricks_ids.c - bricks with ids have the bricks of those without, and the ids of the dense grid: whole and in shares, of any
 * tiles, with lists in any order, and UINT32_MAX for each cell that is clear.
 */
#include "brick_book.h"

#include <stdlib.h>

#include "common/arguments.h"
#include "common/guard.h"

enum { PAIRS = 100000, ROUNDS = 600, IDS = 64 * CASE_WORDS };

static tile_case drawn;
static uint64_t occupied[CASE_WORDS], plain[CASE_WORDS], dense_bits[CASE_WORDS];
static uint32_t dense[IDS];

static const uint32_t tiles[] = {8, 16, 24, 40, 64, 128};

/* A sink that checks ids, and lets a book check the rest. */
typedef struct id_book {
    brick_book book;
    const tile_case *drawn;
} id_book;

/* EXACT has the id of the dense grid; CONSERVATIVE, for which more triangles count, at most that; FAST may err. */
static void check_cell(const id_book *b, const uint32_t cell[3], bool is_set, uint32_t id)
{
    const uint32_t *const size = b->book.size;
    const tribox_accuracy accuracy = b->drawn->options.accuracy;
    if (!is_set) {
        assert_true(id == UINT32_MAX);
        return;
    }
    const size_t row = (size_t)cell[2] * size[1] + cell[1];
    const bool is_dense = dense_bits[row * ((size[0] + 63) / 64) + cell[0] / 64] >> cell[0] % 64 & 1;
    const uint32_t expected = is_dense ? dense[row * size[0] + cell[0]] : UINT32_MAX;
    if (id >= tile_case_triangles(b->drawn) || (accuracy == TRIBOX_EXACT && id != expected) ||
        (accuracy == TRIBOX_CONSERVATIVE && id > expected))
        fail_msg("%s: cell %u %u %u has id %u, not %u", doing, (unsigned)cell[0], (unsigned)cell[1], (unsigned)cell[2],
                 (unsigned)id, (unsigned)expected);
}

static int take(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    id_book *const b = data;
    for (uint32_t n = 0; n < 512; n++)
        check_cell(b, (const uint32_t[3]){8 * at[0] + n % 8, 8 * at[1] + n / 8 % 8, 8 * at[2] + n / 64}, bits[n / 64] >> n % 64 & 1,
                   ids[n]);
    return brick_book_take(&b->book, at, bits);
}

/* The bricks of a share, with scratch at an odd place that had anything, and nothing behind it. */
static void take_share(random_source *r, size_t from, size_t to, const tile_lists *lists)
{
    const size_t offset = (size_t)random_int(r, 64), bytes = tribox_bricks_ids_bytes(drawn.tile) + offset;
    const guarded g = guarded_make(bytes);
    void *const scratch = guarded_tail(g, bytes - offset);
    id_book book = {brick_book_open(&drawn, occupied), &drawn};
    tribox_report report;
    memset(scratch, random_int(r, 2) ? 0 : 0xff, bytes - offset);
    assert_int_equal(tile_case_bricks_ids(&drawn, from, to, lists->starts + from, lists->list, scratch,
                                          &(tribox_ids_sink){take, &book}, &report),
                     TRIBOX_OK);
    assert_int_equal(report.overlapping, book.book.cells);
    guarded_free(g);
}

static void shuffle(random_source *r, const tile_lists *lists, size_t count)
{
    for (size_t t = 0; t < count; t++)
        for (size_t n = lists->starts[t + 1]; n > lists->starts[t] + 1; n--) {
            const size_t other = lists->starts[t] + (size_t)random_int(r, (int)(n - lists->starts[t]));
            const uint32_t number = lists->list[n - 1];
            lists->list[n - 1] = lists->list[other];
            lists->list[other] = number;
        }
}

static void take_plain(size_t count, const tile_lists *lists)
{
    void *const scratch = malloc(tribox_bricks_bytes(drawn.tile));
    brick_book book = brick_book_open(&drawn, plain);
    tribox_report report;
    assert_non_null(scratch);
    memset(plain, 0, sizeof plain);
    assert_int_equal(
        tile_case_bricks(&drawn, 0, count, lists->starts, lists->list, scratch, &(tribox_sink){brick_book_take, &book}, &report),
        TRIBOX_OK);
    free(scratch);
}

static void test_dense(void **state)
{
    const arguments *const args = *state;
    catch_faults();
    random_source r = random_named(args->seed, "ids of bricks");
    for (size_t round = 0; round < arguments_rounds(args, PAIRS / ROUNDS); round++) {
        tile_case_draw(&r, tiles[round % (sizeof tiles / sizeof tiles[0])], &drawn);
        tile_case_tell(&drawn, doing, sizeof doing);
        const size_t count = tile_case_tiles(&drawn);
        const tile_lists lists = tile_case_lists(&drawn, 0, count);
        const tribox_options exact = {.axes = drawn.options.axes, .kernel = "scalar"};
        memset(dense_bits, 0, sizeof dense_bits);
        tile_case_dense_ids(&drawn, &exact, dense_bits, dense);
        take_plain(count, &lists);
        if (random_int(&r, 2))
            shuffle(&r, &lists, count);
        memset(occupied, 0, sizeof occupied);
        for (size_t from = 0, to; from < count; from = to) {
            to = random_int(&r, 2) ? count : from + 1 + (size_t)random_int(&r, (int)(count - from));
            take_share(&r, from, to, &lists);
        }
        assert_memory_equal(occupied, plain, sizeof plain);
        tile_lists_free(lists);
    }
}

static int stop(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    (void)at;
    (void)bits;
    (void)ids;
    return --*(int *)data == 0;
}

/* A triangle through eight bricks: ended at the third of them, and refused. */
static void test_refused(void **state)
{
    (void)state;
    static const float u[9] = {0, 0, 0, 64, 0, 0, 0, 64, 0};
    const tribox_mesh mesh = {.positions = u, .vertices = 3, .count = 1};
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {64, 64, 1}};
    const tribox_tiles all = {64, 0, 1};
    const size_t starts[2] = {0, 1};
    const uint32_t list[1] = {0};
    void *const scratch = malloc(tribox_bricks_ids_bytes(64));
    int left = 3;
    const tribox_ids_sink sink = {stop, &left}, none = {NULL, NULL};
    tribox_mesh endless = mesh;
    assert_non_null(scratch);
    assert_int_equal(tribox_mesh_bricks_ids(&mesh, &grid, &all, starts, list, NULL, scratch, &sink, NULL), TRIBOX_STOPPED);
    assert_int_equal(left, 0);
    assert_int_equal(tribox_mesh_bricks_ids(&mesh, &grid, &all, starts, list, NULL, scratch, &none, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_mesh_bricks_ids(&mesh, &grid, &all, starts, list, NULL, scratch, NULL, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_mesh_bricks_ids(&mesh, &grid, &all, starts, list, NULL, NULL, &sink, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_bricks_ids(NULL, &grid, &all, starts, list, NULL, scratch, &sink, NULL), TRIBOX_BAD_ARGUMENT);
    if (SIZE_MAX > UINT32_MAX) { /* with an index for each corner, vertices of those in lists alone are looked at */
        endless.indices = list;
        endless.index_bytes = 4;
        endless.count = (size_t)UINT32_MAX + 1;
        assert_int_equal(tribox_mesh_bricks_ids(&endless, &grid, &all, starts, list, NULL, scratch, &sink, NULL),
                         TRIBOX_BAD_ARGUMENT);
    }
    free(scratch);
    assert_true(tribox_bricks_ids_bytes(64) >= 64 * 64 * 64 * sizeof(uint32_t) + tribox_bricks_bytes(64));
    assert_true(tribox_bricks_ids_bytes(UINT32_MAX) == SIZE_MAX);
    assert_true(tribox_bricks_ids_bytes(0) < 128 * 1024);
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_dense, &args), cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
