/*
 * test_bricks_lists.c - bricks with ids and with lists have the bricks of those without; in each cell the id of the dense grid, or
 * UINT32_MAX, and the triangles that tiles of one cell list: whole and in shares, of any tiles, with lists in any order, and where
 * bricks are crowded.
 */
#include "brick_book.h"

#include "common/harness.h"

enum { PAIRS = 100000, ROUNDS = 600, WALLS = 500, IDS = 64 * CASE_WORDS };

static tile_case drawn, in_cells;
static uint64_t occupied[CASE_WORDS], plain[CASE_WORDS], dense_bits[CASE_WORDS];
static uint32_t dense[IDS];

static const uint32_t tiles[] = {8, 16, 24, 40, 64, 128};

/* A sink that checks ids or lists, and lets a book check the rest. */
typedef struct list_book {
    brick_book book;
    const tile_lists *cells;
    tribox_accuracy accuracy;
    int copies; /* of each triangle in lists */
} list_book;

/* EXACT has the id of the dense grid; CONSERVATIVE, for which more triangles count, at most that; FAST may err. */
static void check_id(const list_book *b, const uint32_t cell[3], bool is_set, uint32_t id)
{
    const uint32_t *const size = b->book.size;
    if (!is_set) {
        assert_true(id == UINT32_MAX);
        return;
    }
    const size_t row = (size_t)cell[2] * size[1] + cell[1];
    const bool is_dense = dense_bits[row * ((size[0] + 63) / 64) + cell[0] / 64] >> cell[0] % 64 & 1;
    const uint32_t expected = is_dense ? dense[row * size[0] + cell[0]] : UINT32_MAX;
    if (id >= tile_case_triangles(&drawn) || (b->accuracy == TRIBOX_EXACT && id != expected) ||
        (b->accuracy == TRIBOX_CONSERVATIVE && id > expected))
        fail_msg("%s: cell %u %u %u has id %u, not %u", doing, (unsigned)cell[0], (unsigned)cell[1], (unsigned)cell[2],
                 (unsigned)id, (unsigned)expected);
}

static int take_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    list_book *const b = data;
    for (uint32_t n = 0; n < 512; n++)
        check_id(b, (const uint32_t[3]){8 * at[0] + n % 8, 8 * at[1] + n / 8 % 8, 8 * at[2] + n / 64}, bits[n / 64] >> n % 64 & 1,
                 ids[n]);
    return brick_book_take(&b->book, at, bits);
}

/* EXACT has the list of the cell, CONSERVATIVE may have more, FAST may err. */
static void check_list(const list_book *b, size_t cell, const uint32_t *list, size_t count)
{
    const uint32_t *expected = b->cells->list + b->cells->starts[cell], *const end = b->cells->list + b->cells->starts[cell + 1];
    for (size_t n = 0; n < count; n += (size_t)b->copies) {
        if ((n && list[n - 1] >= list[n]) || (b->copies == 2 && list[n + 1] != list[n]))
            fail_msg("%s: cell %zu has %u out of order", doing, cell, (unsigned)list[n]);
        if (expected < end && list[n] == *expected)
            expected++;
        else if (b->accuracy == TRIBOX_EXACT)
            fail_msg("%s: cell %zu has %u, which is not in it", doing, cell, (unsigned)list[n]);
    }
    if (expected < end && b->accuracy != TRIBOX_FAST)
        fail_msg("%s: cell %zu lacks %u", doing, cell, (unsigned)*expected);
}

static int take_lists(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513], const uint32_t *list)
{
    list_book *const b = data;
    const uint32_t *const size = b->book.size;
    assert_int_equal(starts[0], 0);
    for (uint32_t n = 0; n < 512; n++) {
        const size_t i = 8 * at[0] + n % 8, j = 8 * at[1] + n / 8 % 8, k = 8 * at[2] + n / 64, count = starts[n + 1] - starts[n];
        assert_int_equal(bits[n / 64] >> n % 64 & 1, count != 0);
        if (i < size[0] && j < size[1] && k < size[2])
            check_list(b, (k * size[1] + j) * size[0] + i, list + starts[n], count);
    }
    return brick_book_take(&b->book, at, bits);
}

/* The bricks of a share, with scratch at an odd place that had anything, and nothing behind it. */
static void take_share(random_source *r, size_t from, size_t to, const tile_lists *lists, list_book book, bool has_ids)
{
    size_t most = 0;
    for (size_t t = from; t < to; t++)
        most = lists->starts[t + 1] - lists->starts[t] > most ? lists->starts[t + 1] - lists->starts[t] : most;
    const size_t offset = (size_t)random_int(r, 64);
    const size_t bytes = (has_ids ? tribox_bricks_ids_bytes(drawn.tile) : tribox_bricks_lists_bytes(drawn.tile, most)) + offset;
    const guarded g = guarded_make(bytes);
    void *const scratch = guarded_tail(g, bytes - offset);
    tribox_report report;
    book.book = brick_book_open(&drawn, occupied);
    memset(scratch, random_int(r, 2) ? 0 : 0xff, bytes - offset);
    assert_int_equal(has_ids ? tile_case_bricks_ids(&drawn, from, to, lists->starts + from, lists->list, scratch,
                                                    &(tribox_ids_sink){take_ids, &book}, &report)
                             : tile_case_bricks_lists(&drawn, from, to, lists->starts + from, lists->list, scratch,
                                                      &(tribox_lists_sink){take_lists, &book}, &report),
                     TRIBOX_OK);
    assert_int_equal(report.overlapping, book.book.cells);
    guarded_free(g);
}

/* Each number of the lists of tiles once or twice, in order or not. */
static void copy_lists(random_source *r, tile_lists *lists, size_t count, int copies, bool is_ordered)
{
    uint32_t *const twice = malloc(2 * lists->starts[count] * sizeof *twice + 1);
    assert_non_null(twice);
    for (size_t n = 0; n < lists->starts[count]; n++)
        twice[(size_t)copies * n] = twice[(size_t)copies * n + (size_t)copies - 1] = lists->list[n];
    free(lists->list);
    lists->list = twice;
    for (size_t t = 0; t <= count; t++)
        lists->starts[t] *= (size_t)copies;
    for (size_t t = 0; t < count; t++)
        for (size_t n = lists->starts[t + 1]; !is_ordered && n > lists->starts[t] + 1; n--) {
            const size_t other = lists->starts[t] + (size_t)random_int(r, (int)(n - lists->starts[t]));
            const uint32_t number = twice[n - 1];
            twice[n - 1] = twice[other];
            twice[other] = number;
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

static void check(random_source *r)
{
    const size_t count = tile_case_tiles(&drawn);
    list_book book = {.accuracy = drawn.options.accuracy, .copies = random_int(r, 4) ? 1 : 2};
    tile_lists lists = tile_case_lists(&drawn, 0, count);
    in_cells = drawn;
    in_cells.tile = 1;
    in_cells.options = (tribox_options){.axes = drawn.options.axes, .kernel = "scalar"};
    const tile_lists cells = tile_case_lists(&in_cells, 0, tile_case_tiles(&in_cells));
    book.cells = &cells;
    memset(dense_bits, 0, sizeof dense_bits);
    tile_case_dense_ids(&drawn, &in_cells.options, dense_bits, dense);
    take_plain(count, &lists);
    copy_lists(r, &lists, count, book.copies, random_int(r, 2));
    for (int has_ids = 0; has_ids < 2; has_ids++) {
        memset(occupied, 0, sizeof occupied);
        for (size_t from = 0, to; from < count; from = to) {
            to = random_int(r, 2) ? count : from + 1 + (size_t)random_int(r, (int)(count - from));
            take_share(r, from, to, &lists, book, has_ids);
        }
        assert_memory_equal(occupied, plain, sizeof plain);
    }
    tile_lists_free(cells);
    tile_lists_free(lists);
}

CASE(test_dense)
{
    random_source r = random_named(args.seed, "ids of bricks");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        tile_case_draw(&r, tiles[round % (sizeof tiles / sizeof tiles[0])], &drawn);
        tile_case_tell(&drawn, doing, sizeof doing);
        check(&r);
    }
}

/* So many walls through each brick that their pieces do not fit: by parts of a tile, down to a brick that is done twice. */
CASE(test_crowded)
{
    random_source r = random_named(args.seed, "crowded bricks");
    for (int n = 0; n < 8; n++) {
        tile_case_draw(&r, n % 2 ? 8 : 24, &drawn);
        drawn.is_double = drawn.is_mesh = false;
        drawn.options = (tribox_options){.kernel = drawn.options.kernel};
        drawn.at.grid = (tribox_grid){{0, 0, 0}, {1, 1, 1}, {24, 16, 20}};
        drawn.triangles.count = 0;
        for (int wall = 0; wall < (n < 6 ? WALLS : 20); wall++) {
            float u[3][3] = {{0, -40, -40}, {0, 90, -40}, {0, -40, 90}};
            for (int v = 0; v < 3; v++)
                u[v][0] = (float)random_int(&r, wall % 4 ? 6 : 90) / 4;
            triangle_list_put(&drawn.triangles, (const_vertices)u);
        }
        check(&r);
    }
}

static int stop_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    (void)at, (void)bits, (void)ids;
    return --*(int *)data == 0;
}

static int stop_lists(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513], const uint32_t *list)
{
    (void)list;
    return stop_ids(data, at, bits, starts);
}

/* A triangle through eight bricks: ended at the third of them, and refused; by damaged lists too. */
CASE(test_refused)
{
    static const float u[9] = {0, 0, 0, 64, 0, 0, 0, 64, 0};
    const tribox_mesh mesh = {.positions = u, .vertices = 3, .count = 1};
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {64, 64, 1}};
    const tribox_tiles all = {64, 0, 1}, odd = {12, 0, 36};
    const size_t starts[37] = {0, 1}, falling[2] = {2, 1};
    const uint32_t list[1] = {0}, beyond[1] = {1};
    void *const scratch = malloc(tribox_bricks_ids_bytes(64) + tribox_bricks_lists_bytes(64, 1));
    int left = 3, of_lists = 3;
    const tribox_ids_sink sink = {stop_ids, &left}, none = {NULL, NULL};
    const tribox_lists_sink to = {stop_lists, &of_lists};
    tribox_mesh endless = mesh;
    assert_non_null(scratch);
    assert_int_equal(tribox_mesh_bricks_ids(&mesh, &grid, &all, starts, list, NULL, scratch, &sink, NULL), TRIBOX_STOPPED);
    assert_int_equal(tribox_mesh_bricks_lists(&mesh, &grid, &all, starts, list, NULL, scratch, &to, NULL), TRIBOX_STOPPED);
    assert_true(left == 0 && of_lists == 0);
    assert_int_equal(tribox_mesh_bricks_lists(&mesh, &grid, &odd, starts, list, NULL, scratch, &to, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_mesh_bricks_lists(&mesh, &grid, &all, falling, list, NULL, scratch, &to, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_mesh_bricks_lists(&mesh, &grid, &all, starts, beyond, NULL, scratch, &to, NULL), TRIBOX_BAD_VERTEX);
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

PROGRAM(RUN(test_dense), RUN(test_crowded), RUN(test_refused))
