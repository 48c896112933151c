/*
 * test_stack.c - no call takes more stack than the header says, of floats or doubles, on every kernel.
 */
#define _POSIX_C_SOURCE 200809L

#include "common/harness.h"
#include "common/thread_stack.h"

enum { TRIANGLES = 5000, CELLS = 130, STATED = 108 * 1024 };

static double positions[TRIANGLES][3][3];
static float narrow[TRIANGLES][3][3];
static uint32_t indices[3 * TRIANGLES];

static float streams[9][TRIANGLES];
static uint64_t occupied[CELLS * CELLS * ((CELLS + 63) / 64)];

static const tribox_soup soup = {.x = {streams[0], streams[1], streams[2]},
                                 .y = {streams[3], streams[4], streams[5]},
                                 .z = {streams[6], streams[7], streams[8]},
                                 .count = TRIANGLES};

/* Of every size, on planes, partly outside, too large for float: the way of each is walked to its end. */
static void draw_soup(random_source *r)
{
    static const double lengths[] = {0.5, 1, 3, 7, 20, 40, 100};
    for (int t = 0; t < TRIANGLES; t++) {
        const double length = lengths[random_int(r, 7)];
        for (int a = 0; a < 3; a++) {
            const double base = random_double(r, -5, CELLS + 5);
            for (int v = 0; v < 3; v++) {
                const double x = base + length * random_double(r, 0, 1);
                streams[3 * a + v][t] = (float)(random_int(r, 4) ? x : (double)(int)x);
            }
        }
        if (!random_int(r, 50))
            streams[0][t] = 1e30f;
        for (int n = 0; n < 9; n++) {
            positions[t][n % 3][n / 3] = narrow[t][n % 3][n / 3] = streams[n][t];
            indices[3 * t + n / 3] = (uint32_t)(3 * t + n / 3);
        }
    }
}

static void *voxelize(void *options)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}};
    memset(occupied, 0, sizeof occupied);
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, options, occupied, NULL), TRIBOX_OK);
    return NULL;
}

/* The same triangles, in cells of their size, and in cells so small that blocks of them are asked. */
static void *voxelize_mesh(void *options)
{
    const tribox_mesh mesh = {.positions = positions, .vertices = 3 * TRIANGLES, .count = TRIANGLES, .position_bytes = 8};
    static const tribox_window corner = {.size = {CELLS, CELLS, CELLS}};
    for (int is_fine = 0; is_fine < 2; is_fine++) {
        const double cell = is_fine ? 0x1p-1074 : 1;
        const tribox_grid grid = {{0, 0, 0}, {cell, cell, cell}, {UINT32_MAX, UINT32_MAX, UINT32_MAX}};
        memset(occupied, 0, sizeof occupied);
        assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, &corner, options, occupied, NULL), TRIBOX_OK);
    }
    return NULL;
}

/* Tiles, and bricks of them: a voxelization besides what they hold themselves. */
enum { TILE = 40, TILES = 64 };
static size_t starts[TILES + 1];
static uint32_t list[TILES * TRIANGLES];
static unsigned char scratch[256 * 1024];

static int take_none(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)data, (void)at, (void)bits;
    return 0;
}

static int take_no_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    (void)ids;
    return take_none(data, at, bits);
}

static int take_no_lists(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ends[513],
                         const uint32_t *numbers)
{
    (void)ends, (void)numbers;
    return take_none(data, at, bits);
}

/* Of a soup: without ids, with them, and with lists. */
static void *make_bricks(void *options)
{
    static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}};
    static const tribox_tiles all = {TILE, 0, TILES};
    static unsigned char room[16 * 1024 * 1024];
    assert_true(tribox_bricks_lists_bytes(TILE, TRIANGLES) <= sizeof room);
    assert_int_equal(tribox_tile_lists(&soup, &grid, &all, options, starts, NULL), TRIBOX_OK);
    assert_int_equal(tribox_tile_lists(&soup, &grid, &all, options, starts, list), TRIBOX_OK);
    assert_int_equal(tribox_bricks(&soup, &grid, &all, starts, list, options, room, &(tribox_sink){take_none, NULL}, NULL),
                     TRIBOX_OK);
    assert_int_equal(
        tribox_bricks_ids(&soup, &grid, &all, starts, list, options, room, &(tribox_ids_sink){take_no_ids, NULL}, NULL), TRIBOX_OK);
    assert_int_equal(
        tribox_bricks_lists(&soup, &grid, &all, starts, list, options, room, &(tribox_lists_sink){take_no_lists, NULL}, NULL),
        TRIBOX_OK);
    return NULL;
}

static void *make_mesh_bricks(void *options)
{
    static const tribox_mesh mesh = {.positions = positions, .vertices = 3 * TRIANGLES, .count = TRIANGLES, .position_bytes = 8};
    static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}};
    static const tribox_tiles all = {TILE, 0, TILES};
    assert_true(tribox_bricks_bytes(TILE) <= sizeof scratch);
    assert_int_equal(tribox_mesh_tile_lists(&mesh, &grid, &all, options, starts, NULL), TRIBOX_OK);
    assert_int_equal(tribox_mesh_tile_lists(&mesh, &grid, &all, options, starts, list), TRIBOX_OK);
    assert_int_equal(tribox_mesh_bricks(&mesh, &grid, &all, starts, list, options, scratch, &(tribox_sink){take_none, NULL}, NULL),
                     TRIBOX_OK);
    return NULL;
}

/* Of some cells, of which each has all triangles at the most. */
static void *list_cells(void *options)
{
    static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}};
    static const tribox_window some = {{30, 40, 50}, {8, 4, 2}};
    assert_int_equal(tribox_cell_lists(&soup, &grid, &some, options, starts, NULL), TRIBOX_OK);
    assert_int_equal(tribox_cell_lists(&soup, &grid, &some, options, starts, list), TRIBOX_OK);
    return NULL;
}

/* Without options, which these take but at EXACT. */
static void *fill(void *options)
{
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}};
    static uint64_t solid[sizeof occupied / sizeof occupied[0]];
    (void)options;
    memset(occupied, 0, sizeof occupied);
    assert_int_equal(tribox_voxelize_thin(&soup, &grid, NULL, NULL, occupied, NULL), TRIBOX_OK);
    assert_true(tribox_fill_bytes(grid.size) <= sizeof scratch);
    assert_int_equal(tribox_fill_outside(grid.size, occupied, scratch, solid, NULL), TRIBOX_OK);
    assert_int_equal(tribox_fill_parity(&soup, &grid, occupied, scratch, solid, NULL, NULL), TRIBOX_OK);
    return NULL;
}

/* One box, upright and oriented, of triangles as they are, of an index and of an order. */
static void *ask_box(const tribox_index *index, const tribox_options *options)
{
    static const tribox_box box = {{40, 40, 40}, {90, 80, 70}};
    static const tribox_oriented_box turned = {{60, 60, 60}, {30, 20, 10}, {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}}};
    static uint64_t mask[(TRIANGLES + 63) / 64];
    size_t found;
    assert_true(tribox_index_bytes(TRIANGLES) <= sizeof scratch && 16 * TRIANGLES <= sizeof scratch);
    if (index->soup) {
        assert_int_equal(tribox_overlap(index->soup, &box, options, mask, NULL), TRIBOX_OK);
        assert_int_equal(tribox_overlap_oriented(index->soup, &turned, options, mask, NULL), TRIBOX_OK);
        assert_int_equal(tribox_soup_sort(index->soup, list, scratch), TRIBOX_OK);
        assert_int_equal(tribox_split(index->soup, list, TRIANGLES, &box, NULL, options, (uint8_t *)scratch, NULL), TRIBOX_OK);
    } else {
        assert_int_equal(tribox_mesh_overlap(index->mesh, &box, options, mask, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_overlap_oriented(index->mesh, &turned, options, mask, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_sort(index->mesh, list, scratch), TRIBOX_OK);
        assert_int_equal(tribox_mesh_split(index->mesh, list, TRIANGLES, &box, NULL, options, (uint8_t *)scratch, NULL), TRIBOX_OK);
    }
    assert_int_equal(tribox_index_build(index, options, scratch), TRIBOX_OK);
    assert_int_equal(tribox_index_list(index, &(tribox_region){.box = &box}, options, TRIANGLES, list, &found), TRIBOX_OK);
    assert_int_equal(tribox_index_list(index, &(tribox_region){.oriented = &turned}, options, TRIANGLES, list, &found), TRIBOX_OK);
    return NULL;
}

static void *ask_soup(void *options) { return ask_box(&(tribox_index){.soup = &soup, .nodes = scratch}, options); }

static void *ask_mesh(void *options)
{
    const tribox_mesh mesh = {.positions = positions, .vertices = 3 * TRIANGLES, .count = TRIANGLES, .position_bytes = 8};
    return ask_box(&(tribox_index){.mesh = &mesh, .nodes = scratch}, options);
}

/* A byte for each vertex is on the stack then. */
static void *ask_indexed(void *options)
{
    static const tribox_box box = {{40, 40, 40}, {90, 80, 70}};
    static uint64_t mask[(TRIANGLES + 63) / 64];
    for (int is_double = 0; is_double < 2; is_double++) {
        const tribox_mesh mesh = {.positions = is_double ? (const void *)positions : narrow,
                                  .vertices = 3 * TRIANGLES,
                                  .indices = indices,
                                  .index_bytes = 4,
                                  .count = TRIANGLES,
                                  .position_bytes = is_double ? 8 : 4};
        size_t found;
        assert_int_equal(tribox_mesh_overlap(&mesh, &box, options, mask, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_classify(&mesh, &box, options, mask, NULL, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_find(&mesh, &box, options, TRIBOX_FIRST_MISS, &found), TRIBOX_OK);
    }
    return NULL;
}

static const struct {
    const char *name;
    void *(*run)(void *);
} calls[] = {{"tribox_voxelize", voxelize},
             {"tribox_mesh_voxelize", voxelize_mesh},
             {"tribox_bricks", make_bricks},
             {"tribox_mesh_bricks", make_mesh_bricks},
             {"tribox_cell_lists", list_cells},
             {"thin surfaces and fills", fill},
             {"boxes about a soup", ask_soup},
             {"boxes about a mesh", ask_mesh},
             {"boxes about an indexed mesh", ask_indexed}};

static void check_stack(void *(*run)(void *), const char *name, tribox_options *options)
{
    const size_t taken = stack_of(run, options);
    if (taken > STATED)
        fail_msg("%s, %s, accuracy %d: %zu bytes of stack, %d are stated", name, options->kernel, (int)options->accuracy, taken,
                 STATED);
}

CASE(test_stack)
{
    random_source r = random_named(args.seed, "stack");
    if (!is_ordinary_build())
        skip();
    draw_soup(&r);
    for (int k = 0; k < kernels; k++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            tribox_options options = {.accuracy = (tribox_accuracy)accuracy, .kernel = names[k]};
            for (size_t n = 0; n < sizeof calls / sizeof calls[0]; n++)
                check_stack(calls[n].run, calls[n].name, &options);
        }
}

PROGRAM(RUN(test_stack))
