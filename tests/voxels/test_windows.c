/*
 * test_windows.c - windows of a grid: EXACT has the bits of the whole, all cells that tribox_overlap reports and no other, in grids
 * too large to be asked as a whole, too; CONSERVATIVE has them all; layers have the bits of the whole at every accuracy. No word is
 * touched besides. Bits are set and never cleared, the report counts the new ones, and neither parts of a soup, nor the order of
 * its triangles, nor that of their vertices changes what is EXACT.
 */
#include "cells.h"

#include <math.h>
#ifndef __wasm__
#include <pthread.h>
#endif

#include "common/harness.h"
#include "common/window_bits.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum {
    PAIRS = 100000,
    ROUNDS = 100,
    SLAB_ROUNDS = 500,
    SOUP_ROUNDS = 250,
    LATE_ROUNDS = 4,
    CELLS_MAX = 8000,
    TRIANGLES = 60,
    MANY = 200,
    WINDOWS = 5,
    LONG_ROW = 330
};

static random_source r;
static cells_case drawn;
static uint64_t whole[CELLS_MAX], expected[CELLS_MAX], before[CELLS_MAX], occupied[CELLS_MAX];

/* Where rows of a window begin and end beside words. */
static const uint32_t lengths[] = {1, 2, 63, 64, 65, 130};
enum { LENGTHS = sizeof lengths / sizeof lengths[0] };

/* Some cells of the window that are set before, or none. */
static void draw_before(void)
{
    const uint32_t *const size = drawn.at.size;
    memset(before, 0, sizeof before);
    for (int n = random_int(&r, 3) ? 0 : 20; n > 0; n--)
        window_put(size, before, random_below(&r, size[0]), random_below(&r, size[1]), random_below(&r, size[2]), true);
}

/* With what is there before, against either page: by what the accuracy promises, or with the very bits of the whole. */
static void ask_window(bool is_as_whole)
{
    const size_t words = cells_words(&drawn);
    for (size_t w = 0; w < words; w++)
        expected[w] |= before[w];
    for (int side = 0; side < 2; side++) {
        memcpy(occupied, before, words * sizeof *occupied);
        cells_add(&drawn, 0, drawn.count, occupied);
        if (is_as_whole && memcmp(occupied, expected, words * sizeof *occupied))
            fail_msg("%s: layers have other bits than the whole", doing);
        cells_check(&drawn, 0, drawn.count, expected, occupied);
    }
}

static void ask_at_all(void)
{
    for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
        drawn.options.accuracy = (tribox_accuracy)accuracy;
        ask_window(false);
    }
}

/* `length` cells of an axis, or what fits: at either end, anywhere, or about the border of a word. */
static void put_span(int a, uint32_t length)
{
    const uint32_t size = drawn.grid.size[a], most = length < size ? length : size, last = size - most;
    const uint32_t anywhere = (uint32_t)random_below(&r, (size_t)last + 1);
    const int way = random_int(&r, 4);
    drawn.at.size[a] = most;
    drawn.at.first[a] = way == 0 ? 0 : way == 1 ? last : anywhere;
    if (way == 2 && (anywhere | 63) + 2 <= last)
        drawn.at.first[a] = (anywhere | 63) + (uint32_t)random_int(&r, 3);
}

static void any_options(void)
{
    drawn.options = (tribox_options){.axes = (unsigned)(random_int(&r, 4) ? 0 : random_int_between(&r, 1, AXIS_SETS)),
                                     .kernel = names[random_int(&r, kernels)]};
}

/* Small grids of every kind of floats, and long rows if they may be; the whole is what test_cells.c compares with the oracle. */
static void draw_pairs(size_t round, bool has_long_rows, int most)
{
    const grid_kind *const kind = grid_kind_at(round % grid_kind_floats());
    if (!has_long_rows || random_int(&r, 2))
        draw_grid_of_kind(&r, kind, CELLS_MAX, &drawn);
    else
        draw_grid_of_size(&r, kind, (const uint32_t[]){LONG_ROW, (uint32_t)random_int_between(&r, 1, 4), 3}, &drawn);
    if (random_int(&r, 4) == 0)
        put_mesh(&r, &drawn);
    put_triangles(&r, NULL, (size_t)random_int_between(&r, 1, most), SIZE_MAX, &drawn);
    any_options();
}

static size_t ask_whole(void)
{
    cells_open(&drawn);
    cells_ask(&drawn, 0, drawn.count, whole);
    return cells_count(whole, cells_words(&drawn));
}

CASE(test_any)
{
    r = random_named(args.seed, "windows");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw_pairs(round, true, TRIANGLES);
        ask_whole();
        for (int n = 0; n < WINDOWS; n++) {
            for (int a = 0; a < 3; a++)
                put_span(a, a == 0 && random_int(&r, 2) ? lengths[random_int(&r, LENGTHS)]
                                                        : (uint32_t)random_int_between(&r, 1, (int)drawn.grid.size[a]));
            draw_before();
            cells_cut(&drawn, whole, expected);
            ask_at_all();
        }
    }
}

/* Whole layers have the bits of the whole, whatever the accuracy. */
static size_t ask_slab(uint32_t first, uint32_t layers)
{
    cells_open(&drawn);
    drawn.at.first[2] = first;
    drawn.at.size[2] = layers;
    memcpy(expected, whole + tribox_window_words((const uint32_t[]){drawn.grid.size[0], drawn.grid.size[1], 1}) * first,
           cells_words(&drawn) * sizeof *expected);
    const size_t set = cells_count(expected, cells_words(&drawn));
    ask_window(true);
    return set;
}

CASE(test_slabs)
{
    r = random_named(args.seed, "slabs");
    memset(before, 0, sizeof before);
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / SLAB_ROUNDS); round++) {
        draw_pairs(round, false, TRIANGLES);
        drawn.options.accuracy = (tribox_accuracy)random_int(&r, 3);
        const size_t set = ask_whole();
        const uint32_t size = drawn.grid.size[2];
        for (uint32_t first = 0; first <= size && size <= 6; first++) /* every slab there is */
            for (uint32_t layers = 0; layers <= size - first; layers++)
                ask_slab(first, layers);
        size_t sum = 0;
        for (uint32_t first = 0, layers; first < size; first += layers) {
            layers = 1 + (uint32_t)random_int(&r, (int)(size - first));
            sum += ask_slab(first, layers);
        }
        assert_int_equal(sum, set);
        ask_slab(size, 0);
    }
}

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
    r = random_named(args.seed, "threads");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / SLAB_ROUNDS); round++) {
        worker workers[THREADS];
        size_t sum = 0;
        draw_pairs(round, false, TRIANGLES);
        drawn.options.kernel = round % 2 ? drawn.options.kernel : NULL;
        const size_t set = ask_whole();
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
        assert_memory_equal(occupied, whole, cells_words(&drawn) * sizeof *whole);
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
            memset(whole, 0, 7 * 16 * sizeof *whole);
            memset(occupied, 0, 7 * 16 * sizeof *whole);
            assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, NULL, &options, whole, NULL), TRIBOX_OK);
            for (uint32_t layer = 0; layer < 16; layer++)
                assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, &(tribox_window){{0, 0, layer}, {8, 7, 1}}, &options,
                                                      occupied + 7 * layer, NULL),
                                 TRIBOX_OK);
            assert_memory_equal(occupied, whole, 7 * 16 * sizeof *whole);
        }
}

/* The window's first plane, its last, or another, and a float next to it. */
static double near_plane(int a)
{
    const tribox_window *const w = &drawn.at;
    const int which = random_int(&r, 3), steps = random_int_between(&r, -1, 1);
    const uint32_t on = which == 0 ? 0 : which == 1 ? w->size[a] : (uint32_t)random_int(&r, (int)w->size[a] + 1);
    const float plane = (float)cells_place(&drawn, a, (double)w->first[a] + on);
    return (double)(steps ? nextafterf(plane, steps < 0 ? -INFINITY : INFINITY) : plane);
}

/* Two vertices about the window or anywhere in the grid, and a third that has a point of the window between them. */
static void draw_through(bool is_long, double u[3][3])
{
    const tribox_window *const w = &drawn.at;
    const double part = random_double(&r, 0.1, 1.5), other = random_double(&r, 0, 1.5);
    for (int a = 0; a < 3; a++) {
        const double from = cells_place(&drawn, a, w->first[a] + random_double(&r, -0.5, w->size[a] + 0.5));
        for (int j = 0; j < 2; j++)
            u[j][a] = cells_place(&drawn, a,
                                  is_long ? random_double(&r, -9, drawn.grid.size[a] + 9.0)
                                          : w->first[a] + random_double(&r, -2, w->size[a] + 2.0));
        u[2][a] = from - part * (u[0][a] - from) - other * (u[1][a] - from);
    }
}

/* Some of it on planes, flat on one, of one point or of two. */
static void draw_about(double u[3][3])
{
    const int flat = random_int(&r, 6), exact = random_int(&r, 4), like = random_int(&r, 12);
    draw_through(random_int(&r, 3) == 0, u);
    for (int a = 0; a < 3; a++) {
        const double plane = near_plane(a);
        for (int j = 0; j < 3; j++)
            if (a == flat)
                u[j][a] = plane;
            else if (exact == 0 || (exact == 1 && random_int(&r, 2)))
                u[j][a] = near_plane(a);
    }
    if (like < 3)
        memcpy(u[like], u[(like + 1) % 3], sizeof u[0]);
    if (like == 0)
        memcpy(u[2], u[0], sizeof u[0]);
}

/* Sizes whose whole exceeds 2^31 words or whose planes exceed what floats count; planes of whole numbers, rounded, and far away. */
static void draw_large_grid(void)
{
    tribox_grid *const grid = &drawn.grid;
    static const double cells[] = {1, 0.25, 0.7, 1.3, 1.9999999};
    const int longest = random_int(&r, 16), way = random_int(&r, 3);
    for (int a = 0; a < 3; a++) {
        grid->size[a] = a == longest ? 1 << 24 : 65536;
        grid->cell[a] = cells[random_int(&r, sizeof cells / sizeof cells[0])];
        grid->origin[a] = a == longest || way == 0 ? -0.5 * grid->size[a] * grid->cell[a]
                          : way == 1               ? 0
                                                   : random_double(&r, 1, 2) * 0x1p18; /* a cell has few floats */
    }
}

/* EXACT and the others of 20 triangles about the window. Returns the cells that are set. */
static size_t ask_large(void)
{
    drawn.is_double = false;
    drawn.form = SOUP;
    for (drawn.count = 0; drawn.count < 20;) {
        double u[3][3];
        draw_about(u);
        cells_put(&drawn, u);
    }
    any_options();
    draw_before();
    cells_expect(&drawn, 0, drawn.count, drawn.options.axes ? drawn.options.axes : TRIBOX_AXES_ALL, expected);
    const size_t set = cells_count(expected, cells_words(&drawn));
    ask_at_all();
    return set;
}

/* Where no call can write the whole. */
CASE(test_large_grids)
{
    const size_t rounds = arguments_rounds(&args, PAIRS / ROUNDS);
    size_t set = 0;
    r = random_named(args.seed, "windows of large grids");
    drawn.scene = "large grids";
    for (size_t round = 0; round < rounds; round++) {
        draw_large_grid();
        for (int a = 0; a < 3; a++)
            put_span(a, a == 0 ? lengths[random_int(&r, LENGTHS)] : (uint32_t)random_int_between(&r, 1, 6));
        set += ask_large();
    }
    assert_true(set > 20 * rounds);
}

/* Windows near the origin, where floats are fine, but not the numbers of planes: they begin beyond 2^24. */
CASE(test_late_windows)
{
    r = random_named(args.seed, "late windows");
    drawn.grid = (tribox_grid){{-0x1p24, -8, -8}, {1, 1, 1}, {1 << 25, 16, 16}};
    for (size_t round = 0; round < LATE_ROUNDS; round++) {
        const uint32_t first = (1 << 24) + (1 << 14) + (uint32_t)random_int(&r, 1 << 22);
        drawn.at = (tribox_window){.first = {first, 5, 5}, .size = {lengths[round % LENGTHS], 6, 6}};
        ask_large();
    }
}

static size_t ask(const tribox_soup *soup, uint64_t *words)
{
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    assert_int_equal(tribox_voxelize(soup, &drawn.grid, NULL, &drawn.options, words, &report), TRIBOX_OK);
    return report.overlapping;
}

/* Bits that are there stay, those past the end of a row too, and do not count. */
CASE(test_bits_stay)
{
    r = random_named(args.seed, "bits stay");
    for (size_t round = 0; round < SOUP_ROUNDS * arguments_rounds(&args, PAIRS); round++) {
        draw_pairs(round, false, MANY);
        drawn.options.accuracy = (tribox_accuracy)(round % 2 ? 0 : random_int(&r, 3));
        const soup_or_mesh of = cells_all(&drawn);
        ask_whole();
        const size_t words = cells_words(&drawn);
        for (size_t w = 0; w < words; w++) {
            before[w] = occupied[w] = random_bits(&r) & (round % 3 ? ~UINT64_C(0) : random_bits(&r) & random_bits(&r));
            expected[w] = before[w] | whole[w];
        }
        assert_int_equal(ask(&of.soup, occupied), cells_count(expected, words) - cells_count(before, words));
        assert_memory_equal(occupied, expected, words * sizeof *expected);
        assert_int_equal(ask(&of.soup, occupied), 0);
        assert_int_equal(tribox_voxelize(&of.soup, &drawn.grid, NULL, &drawn.options, occupied, NULL), TRIBOX_OK);
        assert_memory_equal(occupied, expected, words * sizeof *expected);
    }
}

CASE(test_parts)
{
    r = random_named(args.seed, "parts");
    for (size_t round = 0; round < SOUP_ROUNDS * arguments_rounds(&args, PAIRS); round++) {
        draw_pairs(round, false, MANY);
        const size_t set = ask_whole();
        size_t sum = 0;
        memset(occupied, 0, cells_words(&drawn) * sizeof *occupied);
        for (size_t first = 0, count; first < drawn.count; first += count) {
            count = 1 + (size_t)random_int(&r, (int)(drawn.count - first));
            const soup_or_mesh part = cells_part(&drawn, first, count, permutations[random_int(&r, ORDERS)]);
            sum += ask(&part.soup, occupied);
        }
        assert_int_equal(sum, set);
        assert_memory_equal(occupied, whole, cells_words(&drawn) * sizeof *occupied);
    }
}

/* The triangles in any order, each with its vertices in any order, and triangles that are not finite among them. */
CASE(test_order)
{
    static cells_case turned;
    r = random_named(args.seed, "order");
    for (size_t round = 0; round < SOUP_ROUNDS * arguments_rounds(&args, PAIRS); round++) {
        draw_pairs(round, false, MANY);
        const size_t set = ask_whole(), start = (size_t)random_int(&r, (int)drawn.count);
        turned.count = 0;
        for (size_t k = 0; k < drawn.count; k++) {
            double v[3][3];
            const int *const vertex = permutations[random_int(&r, ORDERS)];
            for (int j = 0; j < 3; j++)
                memcpy(v[j], drawn.u[(start + drawn.count - k) % drawn.count][vertex[j]], sizeof v[j]);
            cells_put(&turned, v);
            if (random_int(&r, 3))
                continue;
            v[random_int(&r, 3)][random_int(&r, 3)] = random_int(&r, 2) ? NAN : random_int(&r, 2) ? INFINITY : -INFINITY;
            cells_put(&turned, v);
        }
        const soup_or_mesh of = cells_all(&turned);
        memset(occupied, 0, cells_words(&drawn) * sizeof *occupied);
        assert_int_equal(ask(&of.soup, occupied), set);
        assert_memory_equal(occupied, whole, cells_words(&drawn) * sizeof *occupied);
    }
}

/* Not even over the whole grid, at any accuracy and with any axes. */
CASE(test_not_finite)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    r = random_named(args.seed, "not finite");
    draw_grid_of_kind(&r, grid_kind_at(3), CELLS_MAX, &drawn);
    for (int kernel = 0; kernel < kernels; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
                drawn.count = 0;
                for (int k = 0; k < 9 * 4 * 3; k++) {
                    double u[3][3];
                    draw_triangle(&r, triangle_kind_at((size_t)random_int(&r, 4)), &drawn, u);
                    u[k % 3][k / 3 % 3] = (double)bad[k / 9 % 4];
                    cells_put(&drawn, u);
                }
                drawn.options = (tribox_options){.accuracy = (tribox_accuracy)accuracy, .axes = axes, .kernel = names[kernel]};
                assert_int_equal(ask_whole(), 0);
            }
}

PROGRAM(RUN(test_any), RUN(test_slabs), RUN_THREADS RUN(test_blocks), RUN(test_large_grids), RUN(test_late_windows),
        RUN(test_bits_stay), RUN(test_parts), RUN(test_order), RUN(test_not_finite))
