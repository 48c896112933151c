/*
 * test_windows.c - windows of a grid: EXACT has the bits of the whole, all cells that tribox_overlap reports and no other, in grids
 * too large to be asked as a whole, too; CONSERVATIVE has them all. No word is touched besides, and of bad windows none.
 */
#include "occupancy.h"

#include <math.h>

#include "common/harness.h"
#include "common/contact.h"
#include "common/float_environment.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum {
    PAIRS = 100000,
    ROUNDS = 100,
    FEW_ROUNDS = 10,
    LATE_ROUNDS = 4,
    CELLS_MAX = 8000,
    TRIANGLES = 60,
    WINDOWS = 5,
    LONG_ROW = 330
};

static grid_planes at;
static triangle_list triangles;
static uint64_t whole[CELLS_MAX], expected[CELLS_MAX], before[CELLS_MAX];

/* Where rows of a window begin and end beside words. */
static const uint32_t lengths[] = {1, 2, 63, 64, 65, 130};
enum { LENGTHS = sizeof lengths / sizeof lengths[0] };

static size_t row_words(const tribox_window *w) { return (w->size[0] + 63) / 64; }
static size_t window_words(const tribox_window *w) { return row_words(w) * w->size[1] * w->size[2]; }

static uint64_t *word_of(const tribox_window *w, uint64_t *words, uint32_t i, uint32_t j, uint32_t k)
{
    return &words[((size_t)k * w->size[1] + j) * row_words(w) + i / 64];
}

/* The cells of the window among those of the whole. */
static void expect_of_whole(const tribox_window *w)
{
    memset(expected, 0, window_words(w) * sizeof *expected);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const bool is = grid_planes_bit(&at, whole, (int)(w->first[0] + i), (int)(w->first[1] + j), (int)(w->first[2] + k));
                *word_of(w, expected, i, j, k) |= (uint64_t)is << i % 64;
            }
}

static void tell(const tribox_window *w, const tribox_grid *grid, const tribox_options *options)
{
    snprintf(doing, sizeof doing, "window %u %u %u, %u x %u x %u of %u x %u x %u, accuracy %d, axes %u, kernel %s",
             (unsigned)w->first[0], (unsigned)w->first[1], (unsigned)w->first[2], (unsigned)w->size[0], (unsigned)w->size[1],
             (unsigned)w->size[2], (unsigned)grid->size[0], (unsigned)grid->size[1], (unsigned)grid->size[2],
             (int)options->accuracy, options->axes, options->kernel);
}

/* What the words have to be: `expected` and what was there before; at accuracies but EXACT at least that, and no bits past rows. */
static void check_words(const tribox_window *w, const tribox_grid *grid, const tribox_options *options, const uint64_t *words)
{
    for (size_t n = 0; n < window_words(w); n++) {
        const uint32_t rest = w->size[0] % 64;
        const uint64_t cells = rest && (n + 1) % row_words(w) == 0 ? ~(~UINT64_C(0) << rest) : ~UINT64_C(0);
        const uint64_t wanted = expected[n] | before[n];
        const uint64_t lost = options->accuracy == TRIBOX_FAST ? before[n] & ~words[n] : wanted & ~words[n];
        const uint64_t extra = words[n] & ~(options->accuracy == TRIBOX_EXACT ? wanted : cells);
        if (lost | extra) {
            grid_planes_print(stderr, grid);
            fail_msg("%s: word %zu lacks %#llx, has %#llx too many", doing, n, (unsigned long long)lost, (unsigned long long)extra);
        }
    }
}

/* The window's words lie between guards, first against the page after, then against the one before. */
static void ask_window(const tribox_window *w, const tribox_grid *grid, const tribox_options *options)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    const size_t words = window_words(w), bytes = words * sizeof(uint64_t);
    const guarded g = guarded_make(bytes ? bytes : 1);
    tell(w, grid, options);
    for (int side = 0; side < 2; side++) {
        uint64_t *const occupied = side ? guarded_tail(g, bytes) : (void *)g.first;
        tribox_report report;
        memcpy(occupied, before, bytes);
        assert_int_equal(tribox_voxelize(&soup, grid, w, options, occupied, &report), TRIBOX_OK);
        check_words(w, grid, options, occupied);
        assert_int_equal(report.overlapping, occupancy_count(occupied, words) - occupancy_count(before, words));
    }
    guarded_free(g);
}

/* Some cells of the window, or none. */
static void draw_before(random_source *r, const tribox_window *w)
{
    memset(before, 0, sizeof before);
    if (random_int(r, 3) == 0 && window_words(w))
        for (int n = 0; n < 20; n++) {
            const uint32_t i = (uint32_t)random_int(r, (int)w->size[0]), j = (uint32_t)random_int(r, (int)w->size[1]);
            *word_of(w, before, i, j, (uint32_t)random_int(r, (int)w->size[2])) |= UINT64_C(1) << i % 64;
        }
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

static void draw_triangles(random_source *r)
{
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
    return (tribox_options){.axes = (unsigned)(random_int(r, 4) ? 0 : random_int_between(r, 1, AXIS_SETS)),
                            .kernel = names[random_int(r, kernels)]};
}

/* Small grids and long rows of every kind; the whole is what test_cells.c compares with the oracle. */
static void draw_pairs(random_source *r, size_t round)
{
    const grid_kind *const kind = grid_kind_at(round % grid_kind_count());
    if (random_int(r, 2))
        draw_grid_of_kind(r, kind, CELLS_MAX, &at);
    else
        draw_grid_of_size(r, kind, (const uint32_t[]){LONG_ROW, (uint32_t)random_int_between(r, 1, 4), 3}, &at);
    draw_triangles(r);
}

static void ask_whole(const tribox_options *options)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    memset(whole, 0, at.words * sizeof *whole);
    assert_int_equal(tribox_voxelize(&soup, &at.grid, NULL, options, whole, NULL), TRIBOX_OK);
}

CASE(test_parts)
{
    random_source r = random_named(args.seed, "windows");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS / ROUNDS); round++) {
        draw_pairs(&r, round);
        tribox_options options = any_options(&r);
        ask_whole(&options);
        for (int n = 0; n < WINDOWS; n++) {
            const tribox_window w = draw_window(&r, &at.grid);
            draw_before(&r, &w);
            expect_of_whole(&w);
            for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
                options.accuracy = (tribox_accuracy)accuracy;
                ask_window(&w, &at.grid, &options);
            }
        }
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
                *word_of(w, expected, i, j, k) |= (uint64_t)(report.overlapping > 0) << i % 64;
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
        ask_window(w, grid, &options);
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

PROGRAM(RUN(test_parts), RUN(test_large_grids), RUN(test_late_windows))
