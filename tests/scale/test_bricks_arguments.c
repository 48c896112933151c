/* test_bricks_arguments.c - bad input of every kind to the calls about tiles and bricks; nothing is written or handed on. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "tribox.h"

enum { COUNT = 20, SIDE = 30, TILE = 16, TILES = 8, ROOM = 4096 };

/* A call's arguments, right until a test spoils one. */
typedef struct call {
    bool is_double;
    float streams[9][COUNT];
    double corners[COUNT][9];
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_grid grid;
    tribox_tiles tiles;
    size_t starts[TILES + 1];
    uint32_t list[TILES * COUNT];
    tribox_options options;
    bool has_triangles, has_grid, has_tiles, has_starts, has_list, has_scratch, has_sink, has_take;
} call;

static unsigned char scratch[ROOM * 32];
static size_t bricks; /* handed on */

static int count_brick(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)data, (void)at, (void)bits;
    bricks++;
    return 0;
}

static tribox_status list_tiles(const call *c, size_t *starts, uint32_t *list)
{
    const tribox_grid *const grid = c->has_grid ? &c->grid : NULL;
    const tribox_tiles *const tiles = c->has_tiles ? &c->tiles : NULL;
    size_t *const to = c->has_starts ? starts : NULL;
    return c->is_double ? tribox_mesh_tile_lists(c->has_triangles ? &c->mesh : NULL, grid, tiles, &c->options, to, list)
                        : tribox_tile_lists(c->has_triangles ? &c->soup : NULL, grid, tiles, &c->options, to, list);
}

static tribox_status voxelize(const call *c, tribox_report *report)
{
    const tribox_grid *const grid = c->has_grid ? &c->grid : NULL;
    const tribox_tiles *const tiles = c->has_tiles ? &c->tiles : NULL;
    const size_t *const starts = c->has_starts ? c->starts : NULL;
    const uint32_t *const list = c->has_list ? c->list : NULL;
    void *const bytes = c->has_scratch ? scratch : NULL;
    const tribox_sink sink = {c->has_take ? count_brick : NULL, NULL}, *const to = c->has_sink ? &sink : NULL;
    return c->is_double
               ? tribox_mesh_bricks(c->has_triangles ? &c->mesh : NULL, grid, tiles, starts, list, &c->options, bytes, to, report)
               : tribox_bricks(c->has_triangles ? &c->soup : NULL, grid, tiles, starts, list, &c->options, bytes, to, report);
}

/* A fan of triangles through all tiles. Valid until the next one. */
static call *right_call(bool is_double)
{
    static call c;
    c = (call){.is_double = is_double,
               .soup = {.count = COUNT},
               .mesh = {.positions = c.corners, .vertices = 3 * COUNT, .count = COUNT, .position_bytes = 8},
               .grid = {{0, 0, 0}, {1, 1, 1}, {SIDE, SIDE, SIDE}},
               .tiles = {TILE, 0, TILES},
               .has_triangles = true,
               .has_grid = true,
               .has_tiles = true,
               .has_starts = true,
               .has_list = true,
               .has_scratch = true,
               .has_sink = true,
               .has_take = true};
    for (int n = 0; n < 9; n++)
        for (int i = 0; i < COUNT; i++) {
            c.corners[i][n] = n / 3 == 0 ? 1 : n / 3 == 1 ? SIDE - 1 : (i * (n + 1)) % SIDE;
            c.streams[n][i] = (float)c.corners[i][n];
        }
    for (int v = 0; v < 3; v++) {
        c.soup.x[v] = c.streams[3 * v];
        c.soup.y[v] = c.streams[3 * v + 1];
        c.soup.z[v] = c.streams[3 * v + 2];
    }
    assert_true(tribox_bricks_bytes(TILE) <= sizeof scratch);
    assert_int_equal(list_tiles(&c, c.starts, NULL), TRIBOX_OK);
    assert_true(c.starts[TILES] > 0 && c.starts[TILES] <= TILES * COUNT);
    assert_int_equal(list_tiles(&c, c.starts, c.list), TRIBOX_OK);
    bricks = 0;
    return &c;
}

/* The status of each of the three calls; where it is none of OK, nothing may be written. */
static void check(const call *c, tribox_status counted, tribox_status filled, tribox_status voxelized)
{
    size_t starts[TILES + 1];
    uint32_t list[TILES * COUNT];
    tribox_report report, untouched;
    unsigned char poison[sizeof list];
    memset(poison, 0xa5, sizeof poison);
    memset(&untouched, 0xa5, sizeof untouched);
    memset(starts, 0xa5, sizeof starts);
    assert_int_equal(list_tiles(c, starts, NULL), counted);
    if (counted)
        assert_memory_equal(starts, poison, sizeof starts);
    memset(list, 0xa5, sizeof list);
    memcpy(starts, c->starts, sizeof starts);
    assert_int_equal(list_tiles(c, starts, list), filled);
    assert_memory_equal(starts, c->starts, sizeof starts);
    if (filled)
        assert_memory_equal(list, poison, sizeof list);
    memset(&report, 0xa5, sizeof report);
    memset(scratch, 0xa5, sizeof scratch);
    bricks = 0;
    assert_int_equal(voxelize(c, &report), voxelized);
    if (voxelized)
        assert_memory_equal(&report, &untouched, sizeof report);
    assert_true(!voxelized == (bricks > 0));
}

static void check_all(const call *c, tribox_status status) { check(c, status, status, status); }

static void test_missing(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        const tribox_status bad = TRIBOX_BAD_ARGUMENT;
        call *c = right_call(is_double);
        check_all(c, TRIBOX_OK);
        c->has_triangles = false;
        check_all(c, bad);
        (c = right_call(is_double))->has_grid = false;
        check_all(c, bad);
        (c = right_call(is_double))->has_starts = false;
        check_all(c, bad);
        (c = right_call(is_double))->has_list = false;
        check(c, TRIBOX_OK, TRIBOX_OK, bad);
        (c = right_call(is_double))->has_scratch = false;
        check(c, TRIBOX_OK, TRIBOX_OK, bad);
        (c = right_call(is_double))->has_sink = false;
        check(c, TRIBOX_OK, TRIBOX_OK, bad);
        (c = right_call(is_double))->has_take = false;
        check(c, TRIBOX_OK, TRIBOX_OK, bad);
        (c = right_call(is_double))->has_tiles = false;
        check_all(c, bad);
        c = right_call(is_double);
        c->soup.z[2] = NULL;
        c->mesh.positions = NULL;
        check_all(c, bad);
        c = right_call(is_double);
        c->soup.count = c->mesh.count = SIZE_MAX / 2;
        check_all(c, bad);
#if SIZE_MAX > UINT32_MAX
        c->soup.count = c->mesh.count = ((size_t)1 << 32) + 1;
        check(c, bad, bad, is_double ? TRIBOX_BAD_VERTEX : TRIBOX_OK);
#endif
    }
}

static void test_tiles(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        const tribox_status bad = TRIBOX_BAD_ARGUMENT;
        call *c = right_call(is_double);
        c->tiles.side = 0;
        check_all(c, bad);
        (c = right_call(is_double))->tiles.side = UINT32_MAX; /* one tile */
        check_all(c, bad);
        (c = right_call(is_double))->tiles.count = TILES + 1;
        check_all(c, bad);
        c = right_call(is_double);
        c->tiles = (tribox_tiles){TILE, 3, SIZE_MAX - 1};
        check_all(c, bad);
        static const uint32_t not_of_bricks[] = {4, 15, 17, 20, 1032, UINT32_MAX - 7};
        for (size_t n = 0; n < sizeof not_of_bricks / sizeof not_of_bricks[0]; n++) {
            c = right_call(is_double);
            c->tiles.side = not_of_bricks[n];
            c->tiles.count = 1;
            check(c, TRIBOX_OK, TRIBOX_OK, bad);
        }
    }
}

static void test_grids(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++)
        for (int a = 0; a < 3; a++) {
            static const double cells[] = {0, -1, NAN, INFINITY, 1e-30};
            call *c = right_call(is_double);
            c->grid.size[a] = 0;
            check_all(c, TRIBOX_BAD_GRID);
            c = right_call(is_double);
            c->grid.origin[a] = NAN;
            check_all(c, TRIBOX_BAD_GRID);
            for (size_t n = 0; n < sizeof cells / sizeof cells[0]; n++) {
                c = right_call(is_double);
                c->grid.cell[a] = cells[n];
                c->grid.origin[a] = 1;
                check_all(c, TRIBOX_BAD_GRID);
            }
        }
}

static void test_options(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        call *c = right_call(is_double);
        c->options.axes = 8;
        check_all(c, TRIBOX_BAD_OPTION);
        c = right_call(is_double);
        c->options.accuracy = (tribox_accuracy)3;
        check_all(c, TRIBOX_BAD_OPTION);
        c = right_call(is_double);
        c->options.kernel = "none";
        check_all(c, TRIBOX_NO_KERNEL);
    }
}

static void test_lists(void **state)
{
    (void)state;
    tribox_report report;
    for (int is_double = 0; is_double < 2; is_double++) {
        call *c = right_call(is_double);
        c->starts[2] = c->starts[3] + 1;
        assert_int_equal(voxelize(c, &report), TRIBOX_BAD_ARGUMENT);
        assert_int_equal(bricks, 0);
        c = right_call(is_double);
        assert_int_equal(voxelize(c, &report), TRIBOX_OK);
        const size_t all = bricks;
        static const uint32_t numbers[] = {COUNT, UINT32_MAX};
        for (size_t n = 0; n < 2; n++)
            for (size_t at = 0; at < c->starts[TILES]; at++) {
                const uint32_t right = c->list[at];
                bricks = 0;
                c->list[at] = numbers[n];
                assert_int_equal(voxelize(c, &report), TRIBOX_BAD_VERTEX);
                assert_true(at < c->starts[1] ? !bricks : bricks < all);
                assert_true(at < c->starts[TILES - 1] || bricks > 0);
                c->list[at] = right;
            }
    }
}

/* Wrong indices count in the triangles of a list alone. */
static void test_indices(call *c)
{
    uint32_t corners[3 * COUNT];
    tribox_report report;
    for (uint32_t i = 0; i < 3 * COUNT; i++)
        corners[i] = i;
    c->mesh.vertices = 3 * COUNT;
    c->mesh.indices = corners;
    c->mesh.index_bytes = sizeof *corners;
    assert_int_equal(voxelize(c, &report), TRIBOX_OK);
    for (uint32_t i = 0; i < 3 * COUNT; i++) {
        bool is_listed = false;
        for (size_t at = 0; at < c->starts[TILES]; at++)
            is_listed |= c->list[at] == i / 3;
        corners[i] = 3 * COUNT;
        assert_int_equal(voxelize(c, &report), is_listed ? TRIBOX_BAD_VERTEX : TRIBOX_OK);
        corners[i] = i;
    }
    for (size_t at = 0; at < c->starts[TILES]; at++)
        c->list[at] = 0;
    corners[3 * COUNT - 1] = UINT32_MAX;
    assert_int_equal(voxelize(c, &report), TRIBOX_OK);
    c->mesh.indices = NULL;
    c->mesh.index_bytes = 0;
}

/* Vertices that a mesh does not have, and none at all. */
static void test_meshes(void **state)
{
    (void)state;
    call *const c = right_call(true);
    c->mesh.vertices = 3 * COUNT - 1;
    check_all(c, TRIBOX_BAD_VERTEX);
    test_indices(c);
    c->mesh.vertices = 3 * COUNT;
    c->mesh.position_bytes = 5;
    check_all(c, TRIBOX_BAD_ARGUMENT);
}

static void test_no_triangles(void **state)
{
    (void)state;
    for (int is_double = 0; is_double < 2; is_double++) {
        size_t starts[TILES + 1];
        tribox_report report = {1, 1};
        call *const c = right_call(is_double);
        c->soup = (tribox_soup){.count = 0};
        c->mesh = (tribox_mesh){.count = 0};
        assert_int_equal(list_tiles(c, starts, NULL), TRIBOX_OK);
        for (int t = 0; t <= TILES; t++)
            assert_int_equal(starts[t], 0);
        memcpy(c->starts, starts, sizeof starts);
        assert_int_equal(voxelize(c, &report), TRIBOX_OK);
        assert_int_equal(bricks, 0);
        assert_int_equal(report.overlapping, 0);
        c->tiles.first = TILES;
        c->tiles.count = 0;
        assert_int_equal(list_tiles(c, starts, NULL), TRIBOX_OK);
        assert_int_equal(starts[0], 0);
    }
}

static void test_bytes(void **state)
{
    (void)state;
    assert_true(tribox_bricks_bytes(8) >= 8 * 8 * sizeof(uint64_t));
    assert_true(tribox_bricks_bytes(128) >= 128 * 128 * 2 * sizeof(uint64_t));
    assert_true(tribox_bricks_bytes(128) < 512 * 1024);
    assert_true(tribox_bricks_bytes(UINT32_MAX) == SIZE_MAX);
    assert_true(tribox_bricks_bytes(0) < 128 * 1024);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_missing),      cmocka_unit_test(test_tiles), cmocka_unit_test(test_grids),
        cmocka_unit_test(test_options),      cmocka_unit_test(test_lists), cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_no_triangles), cmocka_unit_test(test_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
