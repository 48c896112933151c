/*
 * test_bricks.c - bricks have the bits of the dense grid, each once and in order; with ids, in each cell that of the dense grid or
 * UINT32_MAX; with lists, the triangles that tiles of one cell list. Whole and in shares, of any tiles, with lists in any order,
 * where bricks are crowded, in any environment, and up to where the sink ends the call.
 */
#include "common/float_environment.h"
#include "common/harness.h"
#include "common/window_bits.h"
#include "tile_case.h"

enum { PAIRS = 100000, ROUNDS = 600, WALLS = 500, IDS = 64 * CASE_WORDS, LARGE = 1024 };

static tile_case drawn, in_cells;
static uint64_t occupied[CASE_WORDS], whole[CASE_WORDS], dense_bits[CASE_WORDS];
static uint32_t dense[IDS];

/* In a large tile there is no room for ids. */
static const uint32_t tiles[] = {8, 16, 24, 40, 64, 128, LARGE};

/* Checks what it is handed, and keeps the bits as those of a dense grid. */
typedef struct brick_book {
    const uint32_t *size; /* of the grid */
    uint32_t tile;
    uint64_t *occupied;   /* NULL to keep nothing */
    size_t bricks, cells; /* handed on by now */
    size_t most;          /* bricks after which it ends the call */
    uint64_t last[4];     /* the place of the last brick: tile, z, y, x */
    unsigned environment; /* in which it has to run */
} brick_book;

/* Without an end, in the environment of now. */
static brick_book open_book(const tile_case *c, uint64_t *to)
{
    return (brick_book){
        .size = c->of.grid.size, .tile = c->tile, .occupied = to, .most = SIZE_MAX, .environment = environment_get()};
}

static uint64_t tile_of(const brick_book *b, const uint32_t at[3])
{
    uint64_t tile = 0;
    for (int a = 2; a >= 0; a--)
        tile = tile * ((b->size[a] + b->tile - 1) / b->tile) + 8 * (uint64_t)at[a] / b->tile;
    return tile;
}

static void check_order(brick_book *b, const uint32_t at[3])
{
    const uint64_t place[4] = {tile_of(b, at), at[2], at[1], at[0]};
    int n = 0;
    while (n < 3 && place[n] == b->last[n])
        n++;
    assert_true(!b->bricks || place[n] > b->last[n]);
    memcpy(b->last, place, sizeof place);
}

static void take_cell(brick_book *b, const uint64_t cell[3])
{
    for (int a = 0; a < 3; a++)
        assert_true(cell[a] < b->size[a]);
    b->cells++;
    if (b->occupied)
        window_put(b->size, b->occupied, cell[0], cell[1], cell[2], true);
}

/*
 * Fails the test where a brick is empty, has a cell outside the grid, or does not come after the last one by the number of its
 * tile, then z, y and x.
 */
static int take_brick(brick_book *b, const uint32_t at[3], const uint64_t bits[8])
{
    const size_t before = b->cells;
    assert_int_equal(environment_get(), b->environment);
    assert_true(b->bricks < b->most);
    check_order(b, at);
    for (uint64_t k = 0; k < 8; k++)
        for (uint64_t n = 0; n < 64; n++)
            if (bits[k] >> n & 1)
                take_cell(b, (uint64_t[3]){8 * (uint64_t)at[0] + n % 8, 8 * (uint64_t)at[1] + n / 8, 8 * (uint64_t)at[2] + k});
    assert_true(b->cells > before);
    return ++b->bricks >= b->most;
}

/* What comes with bits. */
typedef enum brick_kind { WITH_NOTHING, WITH_IDS, WITH_LISTS, BRICK_KINDS } brick_kind;

/* A sink that checks ids or lists, and lets a book check the rest. */
typedef struct list_book {
    brick_book book;
    const tile_lists *cells;
    tribox_accuracy accuracy;
    int copies; /* of each triangle in lists */
} list_book;

static int take_bits(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    return take_brick(&((list_book *)data)->book, at, bits);
}

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
    if (id >= drawn.of.count || (b->accuracy == TRIBOX_EXACT && id != expected) ||
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
    return take_brick(&b->book, at, bits);
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
    return take_brick(&b->book, at, bits);
}

static size_t bytes_of(brick_kind kind, size_t from, size_t to, const tile_lists *lists)
{
    size_t most = 0;
    for (size_t t = from; t < to; t++)
        most = lists->starts[t + 1] - lists->starts[t] > most ? lists->starts[t + 1] - lists->starts[t] : most;
    return kind == WITH_IDS     ? tribox_bricks_ids_bytes(drawn.tile)
           : kind == WITH_LISTS ? tribox_bricks_lists_bytes(drawn.tile, most)
                                : tribox_bricks_bytes(drawn.tile);
}

/*
 * As many bricks of a share as there are or `most`; returns how many. Scratch had anything, and ends at a page or some bytes before
 * one; nothing is written behind it. The sink runs in the environment of the caller.
 */
static size_t take_share(random_source *r, brick_kind kind, size_t from, size_t to, const tile_lists *lists, list_book book,
                         size_t most)
{
    static guarded pages;
    const size_t bytes = bytes_of(kind, from, to, lists), behind = random_int(r, 2) ? (size_t)random_int(r, 64) : 0;
    const any_sink sinks[BRICK_KINDS] = {{.bits = {take_bits, &book}}, {.ids = {take_ids, &book}}, {.lists = {take_lists, &book}}};
    unsigned char *const scratch = guarded_room(&pages, bytes + behind);
    const unsigned normal = environment_get(), set = setting((unsigned)random_int(r, SETTINGS));
    const soup_or_mesh of = cells_all(&drawn.of);
    tribox_report report;
    if (drawn.tile < LARGE)
        memset(scratch, random_int(r, 2) ? 0 : 0xff, bytes);
    memset(scratch + bytes, 0xa5, behind);
    book.book = open_book(&drawn, occupied);
    book.book.most = most;
    book.book.environment = set;
    environment_set(set);
    const tribox_status status =
        tile_case_bricks(&drawn, &of, from, to, lists->starts + from, lists->list, scratch, &sinks[kind], &report);
    const unsigned left = environment_get();
    environment_set(normal);
    assert_int_equal(left, set);
    assert_int_equal(status, book.book.bricks >= most ? TRIBOX_STOPPED : TRIBOX_OK);
    assert_int_equal(report.overlapping, book.book.cells);
    for (size_t n = 0; n < behind; n++)
        assert_int_equal(scratch[bytes + n], 0xa5);
    return book.book.bricks;
}

/* Each number of the lists of tiles once or twice, in order or not. */
static void copy_lists(random_source *r, tile_lists *lists, size_t count, int copies, bool is_ordered)
{
    const size_t bytes = (size_t)copies * lists->starts[count] * sizeof(uint32_t);
    const guarded pages = guarded_make(bytes + 1);
    uint32_t *const twice = guarded_tail(pages, bytes);
    for (size_t n = 0; n < lists->starts[count]; n++)
        twice[(size_t)copies * n] = twice[(size_t)copies * n + (size_t)copies - 1] = lists->list[n];
    guarded_free(lists->list_pages);
    lists->list_pages = pages;
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

/* EXACT has all bits of the dense grid, CONSERVATIVE at least these; FAST may differ within rounding. */
static void check_bits(tribox_accuracy accuracy)
{
    if (accuracy == TRIBOX_EXACT && memcmp(whole, dense_bits, sizeof whole))
        fail_msg("%s: the bits are not those of the dense grid", doing);
    for (size_t w = 0; w < CASE_WORDS && accuracy == TRIBOX_CONSERVATIVE; w++)
        assert_true((dense_bits[w] & ~whole[w]) == 0);
}

static void check(random_source *r)
{
    const size_t count = tile_case_tiles(&drawn);
    list_book book = {.accuracy = drawn.of.options.accuracy, .copies = random_int(r, 4) ? 1 : 2};
    tile_lists lists = tile_case_lists(&drawn, 0, count);
    in_cells = drawn;
    in_cells.tile = 1;
    in_cells.of.options = (tribox_options){.axes = drawn.of.options.axes, .kernel = "scalar"};
    const tile_lists cells = tile_case_lists(&in_cells, 0, tile_case_tiles(&in_cells));
    book.cells = &cells;
    memset(dense_bits, 0, sizeof dense_bits);
    tile_case_dense_ids(&drawn, &in_cells.of.options, dense_bits, dense);
    memset(occupied, 0, sizeof occupied);
    const size_t bricks = take_share(r, WITH_NOTHING, 0, count, &lists, book, SIZE_MAX);
    memcpy(whole, occupied, sizeof whole);
    check_bits(book.accuracy);
    copy_lists(r, &lists, count, book.copies, random_int(r, 2));
    const int kinds = drawn.tile == LARGE ? WITH_IDS : BRICK_KINDS;
    for (int kind = 0; kind < kinds; kind++) {
        memset(occupied, 0, sizeof occupied);
        for (size_t from = 0, to; from < count; from = to) {
            to = random_int(r, 2) ? count : from + 1 + (size_t)random_int(r, (int)(count - from));
            take_share(r, (brick_kind)kind, from, to, &lists, book, SIZE_MAX);
        }
        assert_memory_equal(occupied, whole, sizeof whole);
    }
    const size_t most = bricks ? 1 + random_below(r, bricks) : 1;
    assert_int_equal(take_share(r, (brick_kind)random_int(r, kinds), 0, count, &lists, book, most), bricks ? most : 0);
    tile_lists_free(cells);
    tile_lists_free(lists);
}

CASE(test_dense)
{
    random_source r = random_named(args.seed, "kinds of bricks");
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
        drawn.of.is_double = false;
        drawn.of.form = SOUP;
        drawn.of.options = (tribox_options){.kernel = drawn.of.options.kernel};
        drawn.of.grid = (tribox_grid){{0, 0, 0}, {1, 1, 1}, {24, 16, 20}};
        drawn.of.count = 0;
        for (int wall = 0; wall < (n < 6 ? WALLS : 20); wall++) {
            double u[3][3] = {{0, -40, -40}, {0, 90, -40}, {0, -40, 90}};
            for (int v = 0; v < 3; v++)
                u[v][0] = random_int(&r, wall % 4 ? 6 : 90) / 4.0;
            cells_put(&drawn.of, u);
        }
        check(&r);
    }
}

PROGRAM(RUN(test_dense), RUN(test_crowded))
