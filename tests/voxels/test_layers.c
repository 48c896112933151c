/* test_layers.c - a grid in slabs, one after the other and by threads at once: the same bits as the whole, and no word besides. */
#define _POSIX_C_SOURCE 200809L
#include "occupancy.h"

#include <pthread.h>

#include "common/harness.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum { PAIRS = 100000, ROUNDS = 500, FEW_ROUNDS = 100, CELLS_MAX = 8000, TRIANGLES = 90, THREADS_MAX = 8 };

static grid_planes at;
static triangle_list triangles;
static uint64_t whole[CELLS_MAX], parts[CELLS_MAX];

static size_t layer_words(void) { return at.row_words * at.grid.size[1]; }

static void draw_pairs(random_source *r, size_t round)
{
    draw_grid_of_kind(r, grid_kind_at(round % grid_kind_count()), CELLS_MAX, &at);
    triangles.count = 0;
    if (random_int(r, 4) == 0)
        draw_mesh(r, &at, &triangles);
    const size_t wanted = triangles.count + (size_t)random_int_between(r, 1, TRIANGLES);
    while (triangles.count < wanted) {
        float u[3][3];
        draw_triangle(r, triangle_kind_at((size_t)random_int(r, (int)triangle_kind_count())), &at, u);
        triangle_list_put(&triangles, (const_vertices)u);
    }
}

static tribox_options any_options(random_source *r)
{
    return (tribox_options){.accuracy = (tribox_accuracy)random_int(r, 3),
                            .axes = (unsigned)(random_int(r, 4) ? 0 : random_int_between(r, 1, AXIS_SETS)),
                            .kernel = names[random_int(r, kernels)]};
}

static size_t ask_whole(const tribox_options *options)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    tribox_report report;
    memset(whole, 0, at.words * sizeof *whole);
    assert_int_equal(tribox_voxelize(&soup, &at.grid, NULL, options, whole, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, occupancy_count(whole, at.words));
    return report.overlapping;
}

/* The slab's words lie between guards, first against the one after, then against the one before. */
static size_t ask_slab(const tribox_options *options, uint32_t first, uint32_t layers)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    const size_t words = layers * layer_words(), bytes = words * sizeof(uint64_t);
    const guarded g = guarded_make(bytes ? bytes : 1);
    tribox_report report = {0, 0};
    snprintf(doing, sizeof doing, "layers %u and %u more of %u, accuracy %d, axes %u, kernel %s", (unsigned)first, (unsigned)layers,
             (unsigned)at.grid.size[2], (int)options->accuracy, options->axes, options->kernel);
    for (int side = 0; side < 2; side++) {
        uint64_t *const slab = side ? guarded_tail(g, bytes) : (void *)g.first;
        memset(slab, 0, bytes);
        assert_int_equal(tribox_voxelize(&soup, &at.grid,
                                         &(tribox_window){{0, 0, first}, {at.grid.size[0], at.grid.size[1], layers}}, options, slab,
                                         &report),
                         TRIBOX_OK);
        if (words && memcmp(slab, whole + first * layer_words(), bytes))
            fail_msg("%s: the bits are not those of the whole", doing);
        assert_int_equal(report.overlapping, occupancy_count(slab, words));
    }
    guarded_free(g);
    return report.overlapping;
}

CASE(test_slabs)
{
    random_source r = random_named(args.seed, "slabs");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw_pairs(&r, round);
        const tribox_options options = any_options(&r);
        const size_t set = ask_whole(&options);
        const uint32_t size = at.grid.size[2];
        if (size <= 6) /* every slab there is */
            for (uint32_t first = 0; first <= size; first++)
                for (uint32_t layers = 0; layers <= size - first; layers++)
                    ask_slab(&options, first, layers);
        size_t sum = 0;
        for (uint32_t first = 0, layers; first < size; first += layers) {
            layers = 1 + (uint32_t)random_int(&r, (int)(size - first));
            sum += ask_slab(&options, first, layers);
        }
        assert_int_equal(sum, set);
        ask_slab(&options, size, 0);
    }
}

/*
 * In doubles of a spacing of half a cell along x, cells are asked in blocks. Edges along y and z pass cells within rounding: where
 * that stays undecided for a cell, it may be decided for a block of them, and blocks end where layers do.
 */
CASE(test_blocks)
{
    static const double positions[][3][3] = {
        {{0x1.0000000000002p+51, 0x1.ddd9d0e63a757p+0, 0x1.4be5d3b25c99cp+2},
         {0x1.0000000000001p+51, 0x1.02bada9d4f2e7p+1, 0x1.978084b5e7283p+2},
         {0x1.0000000000005p+51, 0x1.df52cf5220d55p-1, 0x1.379117153584p+0}},
        {{0x1.0000000000001p+51, 0x1.32039c2b1e472p-3, 0x1.bc677db64ccebp+1},
         {0x1.0000000000008p+51, 0x1.4dfe9edbedaebp+0, 0x1.88095eb7f64d5p+2},
         {0x1.0000000000013p+51, -0x1.d491feefc3d7p-3, 0x1.8a417486f9698p+2}},
        {{0x1.0000000000003p+51, -0x1.cb8b263115a55p-1, 0x1.941f4ef8e62d9p+2},
         {0x1.000000000000bp+51, 0x1.4694f8cb1c159p+2, 0x1.e203b4d8b4b2dp+2},
         {0x1.ffffffffffff7p+50, 0x1.3233fce3949ap-2, 0x1.db7327334dd78p+2}},
    };
    const tribox_grid grid = {{0x1p51, 0, 0}, {1, 0.625, 0.75}, {8, 7, 16}};
    for (size_t t = 0; t < sizeof positions / sizeof positions[0]; t++)
        for (size_t k = 0; tribox_kernel_list(k); k++) {
            const tribox_mesh mesh = {.positions = positions[t], .vertices = 3, .count = 1, .position_bytes = 8};
            const tribox_options options = {.accuracy = TRIBOX_CONSERVATIVE, .kernel = tribox_kernel_list(k)};
            memset(whole, 0, 7 * 16 * sizeof *whole);
            memset(parts, 0, 7 * 16 * sizeof *parts);
            assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, NULL, &options, whole, NULL), TRIBOX_OK);
            for (uint32_t layer = 0; layer < 16; layer++)
                assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, &(tribox_window){{0, 0, layer}, {8, 7, 1}}, &options,
                                                      parts + 7 * layer, NULL),
                                 TRIBOX_OK);
            assert_memory_equal(parts, whole, 7 * 16 * sizeof *parts);
        }
}

PROGRAM(RUN(test_slabs), RUN(test_blocks))
