/*
 * test_stack.c - no call takes more stack than the header says, of floats or doubles, on every kernel.
 */
#define _POSIX_C_SOURCE 200809L

#include "common/harness.h"
#include "common/soup_or_mesh.h"
#include "common/thread_stack.h"

enum { TRIANGLES = 5000, CELLS = 130, STATED = 108 * 1024 };

static double positions[TRIANGLES][3][3];
static float narrow[TRIANGLES][3][3];
static uint32_t indices[3 * TRIANGLES];

static float streams[9][TRIANGLES];
static uint64_t occupied[CELLS * CELLS * ((CELLS + 63) / 64)];

static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {CELLS, CELLS, CELLS}};
static const tribox_box box = {{40, 40, 40}, {90, 80, 70}};
static soup_or_mesh all; /* one and the same triangles, in doubles as a mesh */

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

/* In cells of their size, and a mesh in cells so small that blocks of them are asked. */
static void *voxelize(void *options)
{
    static const tribox_window corner = {.size = {CELLS, CELLS, CELLS}};
    for (int is_fine = 0; is_fine <= (int)all.is_mesh; is_fine++) {
        const double cell = is_fine ? 0x1p-1074 : 1;
        const tribox_grid vast = {{0, 0, 0}, {cell, cell, cell}, {UINT32_MAX, UINT32_MAX, UINT32_MAX}};
        memset(occupied, 0, sizeof occupied);
        assert_int_equal(CALL(voxelize, &all, &vast, &corner, options, occupied, NULL), TRIBOX_OK);
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

/* Without ids, with them, and with lists. */
static void *make_bricks(void *options)
{
    static const tribox_tiles tiles = {TILE, 0, TILES};
    static const tribox_sink sink = {take_none, NULL};
    static const tribox_ids_sink ids = {take_no_ids, NULL};
    static const tribox_lists_sink lists = {take_no_lists, NULL};
    static unsigned char room[16 * 1024 * 1024];
    assert_true(tribox_bricks_lists_bytes(TILE, TRIANGLES) <= sizeof room);
    assert_int_equal(CALL(tile_lists, &all, &grid, &tiles, options, starts, NULL), TRIBOX_OK);
    assert_int_equal(CALL(tile_lists, &all, &grid, &tiles, options, starts, list), TRIBOX_OK);
    assert_int_equal(CALL(bricks, &all, &grid, &tiles, starts, list, options, room, &sink, NULL), TRIBOX_OK);
    assert_int_equal(CALL(bricks_ids, &all, &grid, &tiles, starts, list, options, room, &ids, NULL), TRIBOX_OK);
    assert_int_equal(CALL(bricks_lists, &all, &grid, &tiles, starts, list, options, room, &lists, NULL), TRIBOX_OK);
    return NULL;
}

/* Of some cells, of which each has all triangles at the most. */
static void *list_cells(void *options)
{
    static const tribox_window some = {{30, 40, 50}, {8, 4, 2}};
    assert_int_equal(CALL(cell_lists, &all, &grid, &some, options, starts, NULL), TRIBOX_OK);
    assert_int_equal(CALL(cell_lists, &all, &grid, &some, options, starts, list), TRIBOX_OK);
    return NULL;
}

/* Without options, which these take but at EXACT. */
static void *fill(void *options)
{
    static uint64_t solid[sizeof occupied / sizeof occupied[0]];
    (void)options;
    memset(occupied, 0, sizeof occupied);
    assert_int_equal(CALL(voxelize_thin, &all, &grid, NULL, NULL, occupied, NULL), TRIBOX_OK);
    assert_true(tribox_fill_bytes(grid.size) <= sizeof scratch);
    assert_int_equal(tribox_fill_outside(grid.size, occupied, scratch, solid, NULL), TRIBOX_OK);
    assert_int_equal(CALL(fill_parity, &all, &grid, occupied, scratch, solid, NULL, NULL), TRIBOX_OK);
    return NULL;
}

/* One box, upright and oriented, of triangles as they are, of an index and of an order. */
static void *ask_box(void *options)
{
    static const tribox_oriented_box turned = {{60, 60, 60}, {30, 20, 10}, {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}}};
    static uint64_t mask[(TRIANGLES + 63) / 64];
    const tribox_index index = {.soup = all.is_mesh ? NULL : &all.soup, .mesh = all.is_mesh ? &all.mesh : NULL, .nodes = scratch};
    size_t found;
    assert_true(tribox_index_bytes(TRIANGLES) <= sizeof scratch && 16 * TRIANGLES <= sizeof scratch);
    assert_int_equal(CALL(overlap, &all, &box, options, mask, NULL), TRIBOX_OK);
    assert_int_equal(CALL(overlap_oriented, &all, &turned, options, mask, NULL), TRIBOX_OK);
    assert_int_equal(all.is_mesh ? tribox_mesh_sort(&all.mesh, list, scratch) : tribox_soup_sort(&all.soup, list, scratch),
                     TRIBOX_OK);
    assert_int_equal(CALL(split, &all, list, TRIANGLES, &box, NULL, options, (uint8_t *)scratch, NULL), TRIBOX_OK);
    assert_int_equal(tribox_index_build(&index, options, scratch), TRIBOX_OK);
    assert_int_equal(tribox_index_list(&index, &(tribox_region){.box = &box}, options, TRIANGLES, list, &found), TRIBOX_OK);
    assert_int_equal(tribox_index_list(&index, &(tribox_region){.oriented = &turned}, options, TRIANGLES, list, &found), TRIBOX_OK);
    return NULL;
}

/* A byte for each vertex is on the stack then. */
static void *ask_indexed(void *options)
{
    static uint64_t mask[(TRIANGLES + 63) / 64];
    for (int is_double = 0; is_double < 2 && all.is_mesh; is_double++) {
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
} calls[] = {{"voxels", voxelize},
             {"bricks", make_bricks},
             {"lists by cell", list_cells},
             {"thin surfaces and fills", fill},
             {"boxes", ask_box},
             {"boxes about an indexed mesh", ask_indexed}};

static void check_stack(void *(*run)(void *), const char *name, tribox_options *options)
{
    const size_t taken = stack_of(run, options);
    if (taken > STATED)
        fail_msg("%s of a %s, %s, accuracy %d: %zu bytes of stack, %d are stated", name, all.is_mesh ? "mesh" : "soup",
                 options->kernel, (int)options->accuracy, taken, STATED);
}

CASE(test_stack)
{
    random_source r = random_named(args.seed, "stack");
    if (!is_ordinary_build())
        skip();
    draw_soup(&r);
    all.soup = soup_of_rows(streams[0], TRIANGLES, TRIANGLES);
    all.mesh = mesh_of_corners(positions, TRIANGLES, 8);
    for (int k = 0; k < kernels; k++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            tribox_options options = {.accuracy = (tribox_accuracy)accuracy, .kernel = names[k]};
            for (size_t n = 0; n < 2 * (sizeof calls / sizeof calls[0]); n++) {
                all.is_mesh = n % 2;
                check_stack(calls[n / 2].run, calls[n / 2].name, &options);
            }
        }
}

PROGRAM(RUN(test_stack))
