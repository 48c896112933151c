/*
 * test_windows.c - windows of a grid: EXACT has the bits of the whole, all cells that tribox_overlap reports and no other, in grids
 * too large to be asked as a whole, too; CONSERVATIVE has them all; layers have the bits of the whole at every accuracy. No word is
 * touched besides. Bits are set and never cleared, the report counts the new ones, and neither parts of a soup, nor the order of
 * its triangles, nor that of their vertices changes what is EXACT.
 */
#include "occupancy.h"

#include <math.h>
#ifndef __wasm__
#include <pthread.h>
#endif

#include "common/contact.h"
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

static grid_planes at;
static triangle_list triangles, turned;
static uint64_t whole[CELLS_MAX], expected[CELLS_MAX], before[CELLS_MAX], occupied[CELLS_MAX];

/* Where rows of a window begin and end beside words. */
static const uint32_t lengths[] = {1, 2, 63, 64, 65, 130};
enum { LENGTHS = sizeof lengths / sizeof lengths[0] };

static size_t window_words(const tribox_window *w) { return tribox_window_words(w->size); }

/* The cells of the window among those of the whole. */
static void expect_of_whole(const tribox_window *w)
{
    memset(expected, 0, window_words(w) * sizeof *expected);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                window_put(w->size, expected, i, j, k,
                           window_bit(at.grid.size, whole, w->first[0] + i, w->first[1] + j, w->first[2] + k));
}

static void tell(const tribox_window *w, const tribox_grid *grid, const tribox_options *options)
{
    snprintf(doing, sizeof doing, "window %u %u %u, %u x %u x %u of %u x %u x %u, accuracy %d, axes %u, kernel %s",
             (unsigned)w->first[0], (unsigned)w->first[1], (unsigned)w->first[2], (unsigned)w->size[0], (unsigned)w->size[1],
             (unsigned)w->size[2], (unsigned)grid->size[0], (unsigned)grid->size[1], (unsigned)grid->size[2],
             (int)options->accuracy, options->axes, options->kernel);
}

/* What the words have to be: `expected` and what was there before; at accuracies but EXACT at least that, and no bits past rows. */
static void check_words(const tribox_window *w, const tribox_grid *grid, tribox_accuracy accuracy, const uint64_t *words)
{
    for (size_t n = 0; n < window_words(w); n++) {
        const uint32_t rest = w->size[0] % 64;
        const uint64_t cells = rest && (n + 1) % window_row(w->size) == 0 ? ~(~UINT64_C(0) << rest) : ~UINT64_C(0);
        const uint64_t wanted = expected[n] | before[n];
        const uint64_t lost = accuracy == TRIBOX_FAST ? before[n] & ~words[n] : wanted & ~words[n];
        const uint64_t extra = words[n] & ~(accuracy == TRIBOX_EXACT ? wanted : cells);
        if (lost | extra) {
            grid_planes_print(stderr, grid);
            fail_msg("%s: word %zu lacks %#llx, has %#llx too many", doing, n, (unsigned long long)lost, (unsigned long long)extra);
        }
    }
}

/* Words as they are due at an accuracy. They lie between guards, first against the page after, then against the one before. */
static void ask_window(const tribox_window *w, const tribox_grid *grid, const tribox_options *options, tribox_accuracy due)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    const size_t words = window_words(w), bytes = words * sizeof(uint64_t);
    const guarded g = guarded_make(bytes ? bytes : 1);
    tell(w, grid, options);
    for (int side = 0; side < 2; side++) {
        uint64_t *const words_of = side ? guarded_tail(g, bytes) : (void *)g.first;
        tribox_report report;
        memcpy(words_of, before, bytes);
        assert_int_equal(tribox_voxelize(&soup, grid, w, options, words_of, &report), TRIBOX_OK);
        check_words(w, grid, due, words_of);
        assert_int_equal(report.overlapping, occupancy_count(words_of, words) - occupancy_count(before, words));
    }
    guarded_free(g);
}

/* Some cells of the window, or none. */
static void draw_before(random_source *r, const tribox_window *w)
{
    memset(before, 0, sizeof before);
    if (random_int(r, 3) == 0 && window_words(w))
        for (int n = 0; n < 20; n++)
            window_put(w->size, before, random_below(r, w->size[0]), random_below(r, w->size[1]), random_below(r, w->size[2]),
                       true);
}

/* `length` cells of an axis, or what fits: at either end, anywhere, or about the border of a word. */
static void put_span(random_source *r, const tribox_grid *grid, int a, uint32_t length, tribox_window *w)
{
    const uint32_t size = grid->size[a];
    w->size[a] = length < size ? length : size;
    const uint32_t last = size - w->size[a];
    const int way = random_int(r, 4);
    const uint32_t anywhere = (uint32_t)random_below(r, (size_t)last + 1);
    w->first[a] = way == 0 ? 0 : way == 1 ? last : anywhere;
    if (way == 2 && (anywhere | 63) + 2 <= last)
        w->first[a] = (anywhere | 63) + (uint32_t)random_int(r, 3);
}

static tribox_window draw_window(random_source *r, const tribox_grid *grid)
{
    tribox_window w;
    for (int a = 0; a < 3; a++)
        put_span(r, grid, a,
                 a == 0 && random_int(r, 2) ? lengths[random_int(r, LENGTHS)]
                                            : (uint32_t)random_int_between(r, 1, (int)grid->size[a]),
                 &w);
    return w;
}

static void draw_triangles(random_source *r, size_t most)
{
    triangles.count = 0;
    if (random_int(r, 4) == 0)
        draw_mesh(r, &at, &triangles);
    const size_t wanted = triangles.count + (size_t)random_int_between(r, 1, (int)most);
    while (triangles.count < wanted) {
        float u[3][3];
        draw_triangle(r, triangle_kind_at((size_t)random_int(r, (int)triangle_kind_count())), &at, u);
        triangle_list_put(&triangles, (const_vertices)u);
    }
}

static tribox_options any_options(random_source *r)
{
    return (tribox_options){.axes = (unsigned)(random_int(r, 4) ? 0 : random_int_between(r, 1, AXIS_SETS)),
                            .kernel = names[random_int(r, kernels)]};
}

/* Small grids of every kind, and long rows if they may be; the whole is what test_cells.c compares with the oracle. */
static void draw_pairs(random_source *r, size_t round, bool has_long_rows, size_t most)
{
    const grid_kind *const kind = grid_kind_at(round % grid_kind_count());
    if (!has_long_rows || random_int(r, 2))
        draw_grid_of_kind(r, kind, CELLS_MAX, &at);
    else
        draw_grid_of_size(r, kind, (const uint32_t[]){LONG_ROW, (uint32_t)random_int_between(r, 1, 4), 3}, &at);
    draw_triangles(r, most);
}

static size_t ask(const tribox_soup *soup, const tribox_options *options, uint64_t *words)
{
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    assert_int_equal(tribox_voxelize(soup, &at.grid, NULL, options, words, &report), TRIBOX_OK);
    return report.overlapping;
}

static size_t ask_whole(const tribox_options *options)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    memset(whole, 0, at.words * sizeof *whole);
    const size_t set = ask(&soup, options, whole);
    assert_int_equal(set, occupancy_count(whole, at.words));
    return set;
}

CASE(test_any)
{
    random_source r = random_named(args.seed, "windows");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw_pairs(&r, round, true, TRIANGLES);
        tribox_options options = any_options(&r);
        ask_whole(&options);
        for (int n = 0; n < WINDOWS; n++) {
            const tribox_window w = draw_window(&r, &at.grid);
            draw_before(&r, &w);
            expect_of_whole(&w);
            for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
                options.accuracy = (tribox_accuracy)accuracy;
                ask_window(&w, &at.grid, &options, options.accuracy);
            }
        }
    }
}

/* Whole layers have the bits of the whole, whatever the accuracy. */
static size_t ask_slab(const tribox_options *options, uint32_t first, uint32_t layers)
{
    const tribox_window w = {{0, 0, first}, {at.grid.size[0], at.grid.size[1], layers}};
    memcpy(expected, whole + first * at.row_words * at.grid.size[1], window_words(&w) * sizeof *expected);
    ask_window(&w, &at.grid, options, TRIBOX_EXACT);
    return occupancy_count(expected, window_words(&w));
}

CASE(test_slabs)
{
    random_source r = random_named(args.seed, "slabs");
    memset(before, 0, sizeof before);
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / SLAB_ROUNDS); round++) {
        draw_pairs(&r, round, false, TRIANGLES);
        tribox_options options = any_options(&r);
        options.accuracy = (tribox_accuracy)random_int(&r, 3);
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

#ifdef __wasm__
#define RUN_THREADS
#else
#define RUN_THREADS RUN(test_threads),
typedef struct worker {
    pthread_t thread;
    const tribox_options *options;
    uint32_t first, layers;
    tribox_report report;
} worker;

static void *work(void *own)
{
    worker *const w = own;
    const tribox_soup soup = triangle_list_soup(&triangles);
    const tribox_window window = {{0, 0, w->first}, {at.grid.size[0], at.grid.size[1], w->layers}};
    tribox_voxelize(&soup, &at.grid, &window, w->options, occupied + w->first * at.row_words * at.grid.size[1], &w->report);
    return NULL;
}

/* Slabs of one grid at once, and a kernel that all choose: for the thread sanitizer. */
CASE(test_threads)
{
    enum { THREADS = 4 };
    random_source r = random_named(args.seed, "threads");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / SLAB_ROUNDS); round++) {
        worker workers[THREADS];
        size_t sum = 0;
        draw_pairs(&r, round, false, TRIANGLES);
        tribox_options options = any_options(&r);
        options.kernel = round % 2 ? options.kernel : NULL;
        const size_t set = ask_whole(&options);
        memset(occupied, 0, at.words * sizeof *occupied);
        for (uint32_t t = 0; t < THREADS; t++) {
            const uint32_t first = at.grid.size[2] * t / THREADS, end = at.grid.size[2] * (t + 1) / THREADS;
            workers[t] = (worker){.options = &options, .first = first, .layers = end - first};
            assert_int_equal(pthread_create(&workers[t].thread, NULL, work, &workers[t]), 0);
        }
        for (uint32_t t = 0; t < THREADS; t++) {
            assert_int_equal(pthread_join(workers[t].thread, NULL), 0);
            sum += workers[t].report.overlapping;
        }
        assert_int_equal(sum, set);
        assert_memory_equal(occupied, whole, at.words * sizeof *whole);
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
            const tribox_mesh mesh = {.positions = positions[t], .vertices = 3, .count = 1, .position_bytes = 8};
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
static float near_plane(random_source *r, const tribox_grid *grid, const tribox_window *w, int a)
{
    const int which = random_int(r, 3), steps = random_int_between(r, -1, 1);
    const uint32_t on = which == 0 ? 0 : which == 1 ? w->size[a] : (uint32_t)random_int(r, (int)w->size[a] + 1);
    const float plane = grid_planes_place(grid, a, (double)w->first[a] + on);
    return steps ? nextafterf(plane, steps < 0 ? -INFINITY : INFINITY) : plane;
}

/* Two vertices about the window or anywhere in the grid, and a third that has a point of the window between them. */
static void draw_through(random_source *r, const tribox_grid *grid, const tribox_window *w, bool is_long, float u[3][3])
{
    const double part = random_double(r, 0.1, 1.5), other = random_double(r, 0, 1.5);
    for (int a = 0; a < 3; a++) {
        const double from = grid_planes_place(grid, a, w->first[a] + random_double(r, -0.5, w->size[a] + 0.5));
        for (int j = 0; j < 2; j++)
            u[j][a] = grid_planes_place(grid, a,
                                        is_long ? random_double(r, -9, grid->size[a] + 9.0)
                                                : w->first[a] + random_double(r, -2, w->size[a] + 2.0));
        u[2][a] = nearest_float(from - part * (u[0][a] - from) - other * (u[1][a] - from));
    }
}

/* Some of it on planes, flat on one, of one point or of two. */
static void draw_about(random_source *r, const tribox_grid *grid, const tribox_window *w, float u[3][3])
{
    const int flat = random_int(r, 6), exact = random_int(r, 4), like = random_int(r, 12);
    draw_through(r, grid, w, random_int(r, 3) == 0, u);
    for (int a = 0; a < 3; a++) {
        const float plane = near_plane(r, grid, w, a);
        for (int j = 0; j < 3; j++)
            if (a == flat)
                u[j][a] = plane;
            else if (exact == 0 || (exact == 1 && random_int(r, 2)))
                u[j][a] = near_plane(r, grid, w, a);
    }
    if (like < 3)
        memcpy(u[like], u[(like + 1) % 3], sizeof u[0]);
    if (like == 0)
        memcpy(u[2], u[0], sizeof u[0]);
}

/* Sizes whose whole exceeds 2^31 words or whose planes exceed what floats count; planes of whole numbers, rounded, and far away. */
static void draw_large_grid(random_source *r, tribox_grid *grid)
{
    static const double cells[] = {1, 0.25, 0.7, 1.3, 1.9999999};
    const int longest = random_int(r, 16), way = random_int(r, 3);
    for (int a = 0; a < 3; a++) {
        grid->size[a] = a == longest ? 1 << 24 : 65536;
        grid->cell[a] = cells[random_int(r, sizeof cells / sizeof cells[0])];
        grid->origin[a] = a == longest || way == 0 ? -0.5 * grid->size[a] * grid->cell[a]
                          : way == 1               ? 0
                                                   : random_double(r, 1, 2) * 0x1p18; /* a cell has few floats */
    }
}

static void expect_by_boxes(const tribox_window *w, const tribox_grid *grid, unsigned axes)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    const tribox_options options = {.axes = axes};
    memset(expected, 0, window_words(w) * sizeof *expected);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const tribox_box box = tribox_grid_cell(grid, w->first[0] + i, w->first[1] + j, w->first[2] + k);
                tribox_report report;
                assert_int_equal(tribox_overlap(&soup, &box, &options, NULL, &report), TRIBOX_OK);
                window_put(w->size, expected, i, j, k, report.overlapping > 0);
            }
}

/* EXACT and the others of 20 triangles about the window, as tribox_overlap answers. Returns the cells that are set. */
static size_t ask_large(random_source *r, const tribox_window *w, const tribox_grid *grid)
{
    tribox_options options = any_options(r);
    for (triangles.count = 0; triangles.count < 20;) {
        float u[3][3];
        draw_about(r, grid, w, u);
        triangle_list_put(&triangles, (const_vertices)u);
    }
    draw_before(r, w);
    expect_by_boxes(w, grid, options.axes);
    for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
        options.accuracy = (tribox_accuracy)accuracy;
        ask_window(w, grid, &options, options.accuracy);
    }
    return occupancy_count(expected, window_words(w));
}

/* Every cell by tribox_overlap, where no call can write the whole. */
CASE(test_large_grids)
{
    random_source r = random_named(args.seed, "windows of large grids");
    const size_t rounds = arguments_rounds(&args, PAIRS / ROUNDS);
    size_t set = 0;
    for (size_t round = 0; round < rounds; round++) {
        tribox_grid grid;
        tribox_window w;
        draw_large_grid(&r, &grid);
        for (int a = 0; a < 3; a++)
            put_span(&r, &grid, a, a == 0 ? lengths[random_int(&r, LENGTHS)] : (uint32_t)random_int_between(&r, 1, 6), &w);
        set += ask_large(&r, &w, &grid);
    }
    assert_true(set > 20 * rounds);
}

/* Windows near the origin, where floats are fine, but not the numbers of planes: they begin beyond 2^24. */
CASE(test_late_windows)
{
    random_source r = random_named(args.seed, "late windows");
    const tribox_grid grid = {{-0x1p24, -8, -8}, {1, 1, 1}, {1 << 25, 16, 16}};
    for (size_t round = 0; round < LATE_ROUNDS; round++) {
        const uint32_t first = (1 << 24) + (1 << 14) + (uint32_t)random_int(&r, 1 << 22);
        ask_large(&r, &(tribox_window){.first = {first, 5, 5}, .size = {lengths[round % LENGTHS], 6, 6}}, &grid);
    }
}

/* Bits that are there stay, those past the end of a row too, and do not count. */
CASE(test_bits_stay)
{
    random_source r = random_named(args.seed, "bits stay");
    for (size_t round = 0; round < SOUP_ROUNDS * arguments_rounds(&args, PAIRS); round++) {
        draw_pairs(&r, round, false, MANY);
        tribox_options options = any_options(&r);
        options.accuracy = (tribox_accuracy)(round % 2 ? 0 : random_int(&r, 3));
        const tribox_soup soup = triangle_list_soup(&triangles);
        size_t news = 0;
        ask_whole(&options);
        for (size_t w = 0; w < at.words; w++) {
            before[w] = random_bits(&r) & (round % 3 ? ~UINT64_C(0) : random_bits(&r) & random_bits(&r));
            occupied[w] = before[w];
            news += (size_t)__builtin_popcountll(whole[w] & ~before[w]);
        }
        assert_int_equal(ask(&soup, &options, occupied), news);
        for (size_t w = 0; w < at.words; w++)
            if (occupied[w] != (before[w] | whole[w]))
                fail_msg("round %zu, word %zu: %#llx and %#llx give %#llx", round, w, (unsigned long long)before[w],
                         (unsigned long long)whole[w], (unsigned long long)occupied[w]);
        assert_int_equal(ask(&soup, &options, occupied), 0);
        assert_int_equal(tribox_voxelize(&soup, &at.grid, NULL, &options, occupied, NULL), TRIBOX_OK);
        for (size_t w = 0; w < at.words; w++)
            assert_int_equal(occupied[w], before[w] | whole[w]);
    }
}

CASE(test_parts)
{
    random_source r = random_named(args.seed, "parts");
    for (size_t round = 0; round < SOUP_ROUNDS * arguments_rounds(&args, PAIRS); round++) {
        draw_pairs(&r, round, false, MANY);
        const tribox_options options = any_options(&r);
        const size_t set = ask_whole(&options);
        size_t sum = 0;
        memset(occupied, 0, at.words * sizeof *occupied);
        for (size_t first = 0, count; first < triangles.count; first += count) {
            count = 1 + (size_t)random_int(&r, (int)(triangles.count - first));
            const tribox_soup part = triangle_list_part(&triangles, first, count, permutations[random_int(&r, ORDERS)]);
            sum += ask(&part, &options, occupied);
        }
        assert_int_equal(sum, set);
        assert_memory_equal(occupied, whole, at.words * sizeof *occupied);
    }
}

/* The triangles in any order, each with its vertices in any order, and triangles that are not finite among them. */
CASE(test_order)
{
    random_source r = random_named(args.seed, "order");
    for (size_t round = 0; round < SOUP_ROUNDS * arguments_rounds(&args, PAIRS); round++) {
        draw_pairs(&r, round, false, MANY);
        const tribox_options options = any_options(&r);
        const size_t set = ask_whole(&options), start = (size_t)random_int(&r, (int)triangles.count);
        turned.count = 0;
        for (size_t k = 0; k < triangles.count; k++) {
            float u[3][3], v[3][3];
            const int *const vertex = permutations[random_int(&r, ORDERS)];
            triangle_list_get(&triangles, (start + triangles.count - k) % triangles.count, u);
            for (int j = 0; j < 3; j++)
                memcpy(v[j], u[vertex[j]], sizeof v[j]);
            triangle_list_put(&turned, (const_vertices)v);
            if (random_int(&r, 3))
                continue;
            v[random_int(&r, 3)][random_int(&r, 3)] = random_int(&r, 2) ? NAN : random_int(&r, 2) ? INFINITY : -INFINITY;
            triangle_list_put(&turned, (const_vertices)v);
        }
        const tribox_soup soup = triangle_list_soup(&turned);
        memset(occupied, 0, at.words * sizeof *occupied);
        assert_int_equal(ask(&soup, &options, occupied), set);
        assert_memory_equal(occupied, whole, at.words * sizeof *occupied);
    }
}

/* Not even over the whole grid, at any accuracy and with any axes. */
CASE(test_not_finite)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    random_source r = random_named(args.seed, "not finite");
    draw_grid_of_kind(&r, grid_kind_at(3), CELLS_MAX, &at);
    for (int kernel = 0; kernel < kernels; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
                triangles.count = 0;
                for (int k = 0; k < 9 * 4 * 3; k++) {
                    float u[3][3];
                    draw_triangle(&r, triangle_kind_at((size_t)random_int(&r, 4)), &at, u);
                    u[k % 3][k / 3 % 3] = bad[k / 9 % 4];
                    triangle_list_put(&triangles, (const_vertices)u);
                }
                const tribox_options options = {.accuracy = (tribox_accuracy)accuracy, .axes = axes, .kernel = names[kernel]};
                assert_int_equal(ask_whole(&options), 0);
                assert_int_equal(occupancy_count(whole, at.words), 0);
            }
}

PROGRAM(RUN(test_any), RUN(test_slabs), RUN_THREADS RUN(test_blocks), RUN(test_large_grids), RUN(test_late_windows),
        RUN(test_bits_stay), RUN(test_parts), RUN(test_order), RUN(test_not_finite))
