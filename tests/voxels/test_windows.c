/*
 * test_windows.c - windows that test_cells.c does not draw: layers of a grid from several threads at once, layers that cut blocks
 * of cells, and rows and columns of more cells or words than 2^31.
 */
#include "cells.h"

#include <math.h>
#ifndef __wasm__
#include <pthread.h>
#endif

#include "common/harness.h"
#include "common/window_bits.h"
#include "kinds.h"

enum { PAIRS_A_ROUND = 200, CELLS_MAX = 8000, TRIANGLES = 60 };

static cells_case drawn;
static uint64_t of_whole[CELLS_MAX], occupied[CELLS_MAX];

#ifdef __wasm__
#define RUN_THREADS
#else
#define RUN_THREADS RUN(test_threads),
typedef struct worker {
    pthread_t thread;
    uint32_t first, layers;
    tribox_report report;
} worker;

static void *work(void *own)
{
    worker *const w = own;
    const soup_or_mesh of = cells_all(&drawn);
    const tribox_window window = {{0, 0, w->first}, {drawn.grid.size[0], drawn.grid.size[1], w->layers}};
    const size_t layer = window_row(window.size) * window.size[1];
    tribox_voxelize(&of.soup, &drawn.grid, &window, &drawn.options, occupied + w->first * layer, &w->report);
    return NULL;
}

/* Slabs of one grid at once, and a kernel that all choose: for the thread sanitizer. */
CASE(test_threads)
{
    enum { THREADS = 4 };
    random_source r = random_named(args.seed, "threads");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        worker workers[THREADS];
        size_t sum = 0;
        draw_grid_of_kind(&r, grid_kind_at(round % grid_kind_floats()), CELLS_MAX, &drawn);
        put_triangles(&r, NULL, (size_t)random_int_between(&r, 1, TRIANGLES), SIZE_MAX, &drawn);
        drawn.options = (tribox_options){.kernel = round % 2 ? names[random_int(&r, kernels)] : NULL};
        cells_ask(&drawn, 0, drawn.count, of_whole);
        const size_t set = bits_set(of_whole, cells_words(&drawn));
        memset(occupied, 0, cells_words(&drawn) * sizeof *occupied);
        for (uint32_t t = 0; t < THREADS; t++) {
            const uint32_t first = drawn.grid.size[2] * t / THREADS, end = drawn.grid.size[2] * (t + 1) / THREADS;
            workers[t] = (worker){.first = first, .layers = end - first};
            assert_int_equal(pthread_create(&workers[t].thread, NULL, work, &workers[t]), 0);
        }
        for (uint32_t t = 0; t < THREADS; t++) {
            assert_int_equal(pthread_join(workers[t].thread, NULL), 0);
            sum += workers[t].report.overlapping;
        }
        assert_int_equal(sum, set);
        assert_memory_equal(occupied, of_whole, cells_words(&drawn) * sizeof *of_whole);
    }
}
#endif

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
            const tribox_mesh mesh = mesh_of_corners(positions[t], 1, 8);
            const tribox_options options = {.accuracy = TRIBOX_CONSERVATIVE, .kernel = tribox_kernel_list(k)};
            memset(of_whole, 0, 7 * 16 * sizeof *of_whole);
            memset(occupied, 0, 7 * 16 * sizeof *of_whole);
            assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, NULL, &options, of_whole, NULL), TRIBOX_OK);
            for (uint32_t layer = 0; layer < 16; layer++)
                assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, &(tribox_window){{0, 0, layer}, {8, 7, 1}}, &options,
                                                      occupied + 7 * layer, NULL),
                                 TRIBOX_OK);
            assert_memory_equal(occupied, of_whole, 7 * 16 * sizeof *of_whole);
        }
}

/* Cells of these by the call about one box. */
static void check_cells(const tribox_mesh *long_one, const tribox_grid *grid, uint32_t first, uint32_t count,
                        const tribox_options *options, const uint64_t *row)
{
    for (uint32_t i = 0; i < count; i++) {
        const tribox_box box = tribox_grid_cell(grid, first + i, 0, 0);
        uint64_t mask;
        assert_int_equal(tribox_mesh_overlap(long_one, &box, options, &mask, NULL), TRIBOX_OK);
        assert_int_equal(mask, row[i / 64] >> i % 64 & 1);
    }
}

/*
 * A row whose cells have numbers beyond 2^31, and triangles that leave it: a small one, and one as long as the row. A plane alone,
 * at the end of the row.
 */
CASE(test_long_rows)
{
    static const double triangles_of[2][3][3] = {{{-7.5, 0.5, 0.5}, {9.25, 0.75, -0.5}, {3, -0.5, 0.75}},
                                                 {{-0x1p31, -0x1p29, 0.25}, {0x1p31, 0x1p29, 0.5}, {0x1p31, 0x1p29, -7}}};
    const uint32_t size = UINT32_MAX - 50, first = 0x7fffffc0, end = UINT32_MAX - 140, part = 140;
    const tribox_window whole = {{0, 0, 0}, {size, 1, 1}}, middle = {{first, 0, 0}, {part, 1, 1}},
                        last = {{end, 0, 0}, {part, 1, 1}};
    const tribox_grid grid = {{-0x1p31, 0, 0}, {1, 1, 1}, {UINT32_MAX, 1, 1}};
    const tribox_options plane = {.axes = TRIBOX_AXES_PLANE};
    uint64_t *const row = calloc(size / 64 + 1, sizeof *row);
    if (!row)
        skip();
    for (int t = 0; t < 2; t++) {
        const tribox_mesh long_one = mesh_of_corners(triangles_of[t], 1, 8);
        uint64_t window[3] = {0}, far[3] = {0};
        tribox_report report, report_of_window;
        assert_int_equal(tribox_mesh_voxelize(&long_one, &grid, &whole, NULL, row, &report), TRIBOX_OK);
        assert_int_equal(tribox_mesh_voxelize(&long_one, &grid, &middle, NULL, window, &report_of_window), TRIBOX_OK);
        assert_in_range(report.overlapping, 4, 20);
        assert_int_equal(report_of_window.overlapping, report.overlapping);
        assert_memory_equal(row + first / 64, window, sizeof window);
        check_cells(&long_one, &grid, first, part, NULL, window);
        assert_int_equal(tribox_mesh_voxelize(&long_one, &grid, &last, &plane, far, NULL), TRIBOX_OK);
        check_cells(&long_one, &grid, end, part, &plane, far);
        memset(row + first / 64, 0, sizeof window);
    }
    free(row);
}

/* The window is the end of a triangle in one column of x, whose layers below it have more words than 2^31. */
CASE(test_long_columns)
{
    enum { ROWS = 4096, LAYERS = 10 };
    static const double corners[3][3] = {{5.5, 3.25, 1}, {5.25, 3.75, 1.2e6}, {5.75, 9.5, 1.2e6}};
    const tribox_mesh column = mesh_of_corners(corners, 1, 8);
    const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {64, ROWS, 1 << 21}};
    const tribox_window end = {{0, 0, 1200000 - LAYERS}, {64, ROWS, LAYERS}};
    static uint64_t cells[LAYERS * ROWS];
    for (size_t n = 0; tribox_kernel_list(n); n++) {
        const tribox_options options = {.kernel = tribox_kernel_list(n)};
        size_t set = 0;
        memset(cells, 0, sizeof cells);
        assert_int_equal(tribox_mesh_voxelize(&column, &grid, &end, &options, cells, NULL), TRIBOX_OK);
        for (uint32_t k = 0; k < LAYERS; k++)
            for (uint32_t j = 0; j < 12; j++) {
                const tribox_box box = tribox_grid_cell(&grid, 5, j, end.first[2] + k);
                uint64_t mask;
                assert_int_equal(tribox_mesh_overlap(&column, &box, &options, &mask, NULL), TRIBOX_OK);
                assert_int_equal(cells[k * ROWS + j], mask << 5);
                set += mask;
            }
        assert_int_equal(bits_set(cells, LAYERS * ROWS), set);
        assert_true(set > LAYERS);
    }
}

PROGRAM(RUN_THREADS RUN(test_blocks), RUN(test_long_rows), RUN(test_long_columns))
