/*
 * test_tall.c - grids of more than 2^31 words, and triangles that go far beyond the few layers, window or tiles that are asked for:
 * tall, long and wide ones, flat ones, lines and bricks. Each cell is compared with the oracle.
 * Fills are not asked: they refuse a grid of more than 2^31 words (tests/scale).
 */
#include "cells.h"

#include <math.h>

#include "common/harness.h"
#include "common/window_bits.h"

enum { TRIANGLES = 12, PAIRS_A_ROUND = 10000, FEW_PAIRS = 40000, WORDS_MAX = 1 << 16, TILE = 64, WIDEST = 10000 };

typedef struct tall_grid {
    const char *name;
    bool is_double, has_layers; /* layers of few words: else windows are asked alone */
    tribox_grid grid;
    int window[3]; /* as many cells a side of a window that is not of whole layers */
} tall_grid;

static const tall_grid grids[] = {
    {"told by floats", false, true, {{0, 0, 0}, {1, 1, 1}, {192, 1024, 1 << 20}}, {40, 40, 5}},
    {"cells of many lengths", false, true, {{-70, -300, -0x1p17}, {0.75, 0.5, 0.25}, {192, 1024, 1 << 20}}, {40, 40, 5}},
    {"more layers than floats tell", false, true, {{0, 0, 0}, {1, 1, 1}, {64, 4096, 1 << 21}}, {20, 20, 5}},
    {"most layers", false, true, {{0, -32, 0}, {1, 1, 1}, {130, 256, 1 << 22}}, {9, 9, 5}},
    {"planes off a little", false, true, {{0, 0, -43230}, {1.1, 0.9, 0.66}, {256, 5000, 131000}}, {20, 20, 5}},
    {"planes off by much", false, true, {{0, 0, 0}, {0.7, 1.3, 0.7}, {70, 600, 1 << 21}}, {20, 20, 5}},
    {"long rows", false, true, {{0, 0, -0x1p19}, {1, 1, 1}, {65000, 3, 1 << 20}}, {70, 70, 5}},
    {"wide", false, false, {{0, 0, 0}, {1, 1, 1}, {1 << 22, 4096, 8192}}, {20, 20, 5}},
    {"long", false, false, {{0, 0, 0}, {1, 0.5, 1}, {4096, 1 << 22, 4096}}, {20, 20, 5}},
    {"wide and told by floats", false, false, {{-0x1p19, 0, 0}, {1, 1, 1}, {1 << 20, 1 << 20, 1 << 20}}, {40, 40, 5}},
    {"all long", false, false, {{-0x1p22, 0, -3}, {1, 0.7, 2}, {1 << 23, 1 << 22, 1 << 22}}, {12, 12, 5}},
    {"tall, doubles", true, true, {{0, 0, -1e6}, {1, 0.1, 1}, {64, 70, UINT32_MAX}}, {70, 5, 5}},
    {"layers of many words, doubles", true, true, {{0, 0, 0}, {1, 1, 0.125}, {130, 30, (uint32_t)1 << 31}}, {70, 5, 5}},
    {"wide, doubles", true, false, {{-1e9, 3, 0}, {0.3, 1, 1}, {UINT32_MAX, 90, 80}}, {70, 5, 5}},
    {"long, doubles", true, false, {{0, -1e9, 0}, {1, 0.7, 1}, {90, UINT32_MAX, 80}}, {70, 5, 5}},
    {"all long, doubles", true, false, {{-5, 1e6, -7}, {0.1, 1, 3}, {UINT32_MAX, UINT32_MAX, 4096}}, {70, 5, 5}},
};
enum { GRIDS = sizeof grids / sizeof grids[0] };

static cells_case drawn;
static uint64_t expected[WORDS_MAX], occupied[WORDS_MAX], layer_words[WORDS_MAX];

/* All axes asked begin with the box normals. Returns how many cells overlap. */
static size_t expect(void)
{
    cells_expect(&drawn, 0, drawn.count, drawn.options.axes ? drawn.options.axes : TRIBOX_AXES_ALL, expected);
    return cells_count(expected, cells_words(&drawn));
}

/* Layers have the bits of the grid at every accuracy: so each alone has those of all. */
static void check_layers(void)
{
    const tribox_window all = drawn.at;
    const size_t layer = window_row(all.size) * all.size[1];
    for (uint32_t k = 0; k < all.size[2]; k++) {
        drawn.at.first[2] = all.first[2] + k;
        drawn.at.size[2] = 1;
        cells_ask(&drawn, 0, drawn.count, layer_words);
        if (memcmp(layer_words, occupied + k * layer, layer * sizeof *occupied))
            fail_msg("%s: the layer alone differs", doing);
    }
    drawn.at = all;
}

/* By every kernel, at every accuracy, against either page. Returns the cells that overlap. */
static size_t ask_all(bool has_layers)
{
    const size_t set = expect();
    for (int n = 0; n < kernels * 3 * 2; n++) {
        drawn.options.kernel = names[n / 6];
        drawn.options.accuracy = (tribox_accuracy)(n / 2 % 3);
        cells_ask(&drawn, 0, drawn.count, occupied);
        cells_check(&drawn, 0, drawn.count, expected, occupied);
        if (n % 2 && has_layers)
            check_layers();
    }
    return set;
}

/*
 * Through the window: on each axis within one cell, over a few, over more than float takes at a time, or over all of the grid, but
 * on x and y no more than `widest` to either side. The point that is in the window lies within a cell, or on planes.
 */
static void draw_triangles(random_source *r, double widest)
{
    for (drawn.count = 0; drawn.count < TRIANGLES;) {
        const double one = random_double(r, 0.2, 1.5), other = random_double(r, 0.1, 1.5);
        const bool is_on_planes = random_int(r, 6) == 0;
        double u[3][3];
        for (int a = 0; a < 3; a++) {
            const double all = 0.5 * drawn.grid.size[a], far = a == 2 || all < widest ? all : widest;
            const double lengths[] = {0.1, 3, 28, far}, most = lengths[random_int(r, 4)];
            const double within = is_on_planes ? 0 : random_double(r, 0.4, 0.6);
            const double in = drawn.at.first[a] + (double)random_below(r, drawn.at.size[a]) + within;
            double by[3] = {random_double(r, -most, most), random_double(r, -most, most)};
            by[2] = -one * by[0] - other * by[1];
            for (int j = 0; j < 3; j++)
                u[j][a] = cells_place(&drawn, a, in + by[j]);
        }
        cells_put(&drawn, u);
    }
}

/* Of every shape, from the first layers to the last; narrow where n has a bit for the axis. */
static void put_by_hand(void)
{
    for (drawn.count = 0; drawn.count < TRIANGLES;) {
        const size_t t = drawn.count;
        double u[3][3];
        for (int a = 0; a < 3; a++) {
            const uint32_t size = drawn.grid.size[a], beside = (uint32_t)(2 * t) % size;
            const double from = a == 2 ? 0 : beside, most = a == 2 ? size - 1 : size < 80 ? size / 2 : 40;
            const double wide[3] = {0.5, most + 0.5, 0.4 * most + 0.5}, narrow[3] = {0.3, 0.7, 0.5};
            const double cell = a == 2 ? drawn.at.first[a] : beside;
            for (int j = 0; j < 3; j++)
                u[j][a] = cells_place(&drawn, a, t >> a & 1 ? cell + narrow[j] : from + wide[j]);
        }
        cells_put(&drawn, u);
    }
}

static void draw_axes(random_source *r)
{
    static const unsigned axes[] = {0, 0, TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE};
    drawn.options = (tribox_options){.axes = axes[random_int(r, 4)]};
}

/* All of the grid. */
static void open_grid(const char *name, bool is_double, const tribox_grid *grid)
{
    drawn.scene = name;
    drawn.is_double = is_double;
    drawn.grid = *grid;
    cells_open(&drawn);
}

/* `length` cells of an axis at either end, anywhere, or the first that lie 2^31 words behind the first layer, or next to them. */
static void put_span(random_source *r, int a, uint32_t length)
{
    const uint32_t size = drawn.grid.size[a];
    const uint64_t layer = ((uint64_t)drawn.grid.size[0] + 63) / 64 * drawn.grid.size[1],
                   far = (uint64_t)random_int_between(r, 1, 2) << 31;
    drawn.at.size[a] = length < size ? length : size;
    const uint32_t last = size - drawn.at.size[a], anywhere = (uint32_t)random_below(r, (size_t)last + 1);
    const int way = random_int(r, 6);
    drawn.at.first[a] = way == 0 ? 0 : way == 1 ? last : anywhere;
    if (a == 2 && way > 3)
        drawn.at.first[2] = far / layer < last ? (uint32_t)(far / layer) + (uint32_t)random_int(r, 2) : last;
}

/* The layers that begin 2^31 words behind the first, and those about them. */
CASE(test_by_hand)
{
    for (size_t n = 0; n < GRIDS && !grids[n].is_double; n++)
        for (uint32_t step = 0; step < 4 && grids[n].has_layers; step++) {
            open_grid(grids[n].name, false, &grids[n].grid);
            const uint32_t layer = (drawn.grid.size[0] + 63) / 64 * drawn.grid.size[1];
            drawn.at.size[2] = 1;
            drawn.at.first[2] = step == 3 ? drawn.grid.size[2] - 1 : (UINT32_C(1) << 31) / layer - 1 + step;
            put_by_hand();
            drawn.options = (tribox_options){0};
            assert_true(ask_all(true) > TRIANGLES);
        }
}

/* Windows of whole layers, or of any cells. */
static void check_grid(random_source *r, const tall_grid *from, bool is_of_layers)
{
    const size_t rounds = arguments_rounds(&args, PAIRS_A_ROUND);
    size_t set = 0;
    for (size_t round = 0; round < rounds; round++) {
        open_grid(from->name, from->is_double, &from->grid);
        for (int a = is_of_layers ? 2 : 0; a < 3; a++)
            put_span(r, a, (uint32_t)random_int_between(r, 1, is_of_layers ? 3 : from->window[a]));
        if (cells_words(&drawn) > WORDS_MAX)
            drawn.at.size[2] = 1;
        draw_triangles(r, INFINITY);
        draw_axes(r);
        set += ask_all(is_of_layers);
    }
    assert_true(set > rounds);
}

CASE(test_layers)
{
    random_source r = random_named(args.seed, "tall layers");
    for (size_t n = 0; n < GRIDS; n++)
        if (grids[n].has_layers)
            check_grid(&r, &grids[n], true);
}

CASE(test_windows)
{
    random_source r = random_named(args.seed, "tall windows");
    for (size_t n = 0; n < GRIDS; n++)
        check_grid(&r, &grids[n], false);
}

/* The tile that begins the window. */
static size_t tile_of(void)
{
    size_t tile = 0;
    for (int a = 2; a >= 0; a--) {
        const uint32_t along = drawn.grid.size[a] / TILE + (drawn.grid.size[a] % TILE != 0), at = drawn.at.first[a] / TILE;
        drawn.at.first[a] = at * TILE;
        drawn.at.size[a] = drawn.grid.size[a] - at * TILE < TILE ? drawn.grid.size[a] - at * TILE : TILE;
        tile = tile * along + at;
    }
    return tile;
}

static int take(void *words, const uint32_t at[3], const uint64_t bits[8])
{
    for (uint32_t n = 0; n < 512; n++) {
        const uint32_t brick[3] = {n % 8, n / 8 % 8, n / 64};
        uint32_t cell[3];
        for (int a = 0; a < 3; a++)
            cell[a] = 8 * at[a] + brick[a] - drawn.at.first[a];
        if (bits[n / 64] >> n % 64 & 1)
            window_put(drawn.at.size, words, cell[0], cell[1], cell[2], true);
    }
    return 0;
}

/* The list of a tile, and its cells from bricks. */
static void ask_bricks(size_t tile)
{
    const soup_or_mesh of = cells_all(&drawn);
    const tribox_tiles one = {TILE, tile, 1};
    const tribox_sink sink = {take, occupied};
    size_t starts[2];
    uint32_t list[TRIANGLES];
    const size_t bytes = tribox_bricks_bytes(TILE);
    const guarded g = guarded_make(bytes);
    void *const scratch = guarded_tail(g, bytes);
    tribox_report report;
    memset(occupied, 0, cells_words(&drawn) * sizeof *occupied);
    assert_int_equal(CALL(tile_lists, &of, &drawn.grid, &one, &drawn.options, starts, NULL), TRIBOX_OK);
    assert_int_equal(CALL(tile_lists, &of, &drawn.grid, &one, &drawn.options, starts, list), TRIBOX_OK);
    assert_int_equal(CALL(bricks, &of, &drawn.grid, &one, starts, list, &drawn.options, scratch, &sink, &report), TRIBOX_OK);
    guarded_free(g);
    assert_int_equal(report.overlapping, cells_count(occupied, cells_words(&drawn)));
}

/* Sizes of powers of two, and cells of any length from zero on or about it, in float or double. */
static void draw_grid(random_source *r)
{
    tribox_grid grid;
    for (int a = 0; a < 3; a++) {
        grid.size[a] = (uint32_t)1 << random_int_between(r, 13, 20);
        grid.cell[a] = random_int(r, 2) ? 0.1 : random_double(r, 0.5, 2);
        grid.origin[a] = random_int(r, 2) ? 0 : -0.5 * grid.size[a] * grid.cell[a];
    }
    open_grid("drawn", random_int(r, 2), &grid);
}

/* A tile anywhere in such grids, by one kernel at every accuracy. Triangles cross few of the tiles that lists look at. */
CASE(test_bricks)
{
    random_source r = random_named(args.seed, "tall bricks");
    for (size_t round = 0; round < GRIDS * arguments_rounds(&args, FEW_PAIRS); round++) {
        if (random_int(&r, 2))
            draw_grid(&r);
        else
            open_grid(grids[round % GRIDS].name, grids[round % GRIDS].is_double, &grids[round % GRIDS].grid);
        if (tribox_tile_count(drawn.grid.size, TILE) == SIZE_MAX) /* on small machines */
            continue;
        for (int a = 0; a < 3; a++)
            put_span(&r, a, 1);
        const size_t tile = tile_of();
        draw_triangles(&r, WIDEST);
        draw_axes(&r);
        drawn.options.kernel = names[random_int(&r, kernels)];
        expect();
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            drawn.options.accuracy = (tribox_accuracy)accuracy;
            snprintf(doing, sizeof doing, "bricks of %s", drawn.scene);
            ask_bricks(tile);
            cells_check(&drawn, 0, drawn.count, expected, occupied);
        }
    }
}

PROGRAM(RUN(test_by_hand), RUN(test_layers), RUN(test_windows), RUN(test_bricks))
