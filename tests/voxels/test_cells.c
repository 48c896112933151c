/*
 * test_cells.c - every kind of triangle in every kind of grid, cell by cell against the oracle: in small grids, in windows of grids
 * of up to 2^96 cells, and real meshes. EXACT is right from every kernel, one triangle a call and many, in parts and windows, by
 * every set of axes; so are the lowest numbers of triangles by cell, and bricks. CONSERVATIVE never misses, nor does FAST for
 * doubles; for floats both err within their band alone. At every accuracy layers have the bits of the whole, which do not depend on
 * the order of the triangles, and bits that are there stay.
 */
#include "cell_oracle.h"
#include "cells.h"

#include <math.h>

#include "common/harness.h"
#include "common/real_meshes.h"
#include "common/window_bits.h"
#include "kinds.h"

enum {
    ROUNDS = 4,                      /* of every kind of triangle in every kind of grid */
    PAIRS_A_ROUND = 100000 / ROUNDS, /* of the arguments: --long asks a hundred times as much, --short a quarter */
    CELLS_MAX = 20000,               /* of a grid, also for ids */
    CELLS_OF_DOUBLES = 2000,         /* a grid of doubles, and one of which all cells are asked about */
    CELLS_FOR_ALL = 300,
    WORDS_MAX = 1 << 16,
    ASKED_MAX = 16000,       /* cells that the oracle is asked about in a run: at this number no more triangles are drawn */
    ASKED_OF_LARGE = 100000, /* of a window of a large grid */
    ALONE_MAX = 24,          /* triangles of a run that are voxelized one by one */
    TILE = 64
};

static random_source r;
static cells_case drawn;
static uint64_t one[WORDS_MAX], all[WORDS_MAX]; /* what the oracle says of a triangle, and of all, in the window drawn */
static uint64_t expected[WORDS_MAX], occupied[WORDS_MAX], before[WORDS_MAX];
static uint32_t lowest[CELLS_MAX]; /* by z, y, x the lowest number of a triangle that is expected, or UINT32_MAX */

static struct {
    size_t runs, asked, set;
    tally conservative, fast;
} sum;

static void choose(tribox_accuracy accuracy, unsigned axes, int kernel)
{
    drawn.options = (tribox_options){
        .accuracy = accuracy, .axes = axes, .axis_order = order_digits(random_int(&r, ORDERS)), .kernel = names[kernel]};
}

static size_t window_cells(void) { return (size_t)drawn.at.size[0] * drawn.at.size[1] * drawn.at.size[2]; }

static bool is_set(const uint64_t *words, size_t cell)
{
    const size_t row = cell / drawn.at.size[0];
    return window_bit(drawn.at.size, words, cell % drawn.at.size[0], row % drawn.at.size[1], row / drawn.at.size[1]);
}

/* The cells that triangle t alone has, which no triangle before it had. */
static void take_one(uint32_t t)
{
    const bool has_ids = window_cells() <= CELLS_MAX;
    for (size_t w = 0, row = window_row(drawn.at.size); w < cells_words(&drawn); w++) {
        for (uint64_t rest = has_ids ? one[w] & ~all[w] : 0; rest; rest &= rest - 1)
            lowest[w / row * drawn.at.size[0] + w % row * 64 + (size_t)__builtin_ctzll(rest)] = t;
        all[w] |= one[w];
    }
}

/* Of each triangle by the oracle; some are voxelized alone, as others might hide what is wrong. Or by what is voxelized alone. */
static void expect(unsigned axes, bool is_by_oracle)
{
    assert_true(cells_words(&drawn) <= WORDS_MAX);
    memset(all, 0, cells_words(&drawn) * sizeof *all);
    memset(lowest, 0xff, sizeof lowest);
    for (size_t t = 0; t < drawn.count; t++) {
        if (!is_by_oracle) {
            cells_ask(&drawn, t, 1, one);
        } else {
            sum.asked += cells_expect(&drawn, t, 1, axes, one);
            if (t % (drawn.count / ALONE_MAX + 1) == 0) {
                choose(TRIBOX_EXACT, axes, random_int(&r, kernels));
                cells_ask(&drawn, t, 1, occupied);
                cells_check(&drawn, t, 1, one, occupied);
            }
        }
        take_one((uint32_t)t);
    }
}

/* In one part or two, of which the second may come first, over what is there before. Returns how many cells are new. */
static size_t ask_in_parts(uint64_t *words)
{
    const size_t middle = random_int(&r, 2) ? random_below(&r, drawn.count + 1) : 0;
    const bool is_turned = random_int(&r, 2);
    const size_t later = cells_add(&drawn, is_turned ? middle : 0, is_turned ? drawn.count - middle : middle, words);
    return later + cells_add(&drawn, is_turned ? 0 : middle, is_turned ? middle : drawn.count - middle, words);
}

/* Bits of any kind, past the ends of rows too, or none. */
static void draw_before(void)
{
    const bool has_bits = random_int(&r, 2);
    for (size_t w = 0; w < cells_words(&drawn); w++)
        before[w] = has_bits ? random_bits(&r) & random_bits(&r) : 0;
}

/* The window, or one in it. */
static void check_exact(unsigned axes, int kernel)
{
    const tribox_window range = drawn.at;
    choose(TRIBOX_EXACT, axes, kernel);
    if (random_int(&r, 2))
        cells_draw_window(&r, &range, range.size, &drawn.at);
    const size_t words = cells_words(&drawn);
    cells_cut(&drawn, &range, all, expected);
    draw_before();
    for (size_t w = 0; w < words; w++)
        expected[w] |= before[w];
    memcpy(occupied, before, words * sizeof *occupied);
    const size_t set = ask_in_parts(occupied);
    cells_check(&drawn, 0, drawn.count, expected, occupied);
    assert_int_equal(set, bits_set(expected, words) - bits_set(before, words));
    drawn.at = range;
}

/* Windows of whole layers have the bits of the window whose layers they are, and so have parts of the triangles. */
static void check_layers(const uint64_t *whole)
{
    const tribox_window range = drawn.at;
    const size_t words = cells_words(&drawn), layer = words / range.size[2];
    size_t set = 0;
    memset(expected, 0, words * sizeof *expected);
    for (uint32_t first = 0, layers; first < range.size[2]; first += layers) {
        layers = 1 + (uint32_t)random_below(&r, range.size[2] - first);
        drawn.at.first[2] = range.first[2] + first;
        drawn.at.size[2] = layers;
        set += ask_in_parts(expected + first * layer);
    }
    drawn.at = range;
    if (memcmp(expected, whole, words * sizeof *expected) || set != bits_set(whole, words))
        fail_msg("%s: layers have or count other bits than the whole", doing);
}

static void check_rounded(tribox_accuracy accuracy, unsigned axes, bool has_band)
{
    choose(accuracy, axes, random_int(&r, kernels));
    cells_ask(&drawn, 0, drawn.count, occupied);
    cells_check(&drawn, 0, drawn.count, all, occupied);
    if (!drawn.is_double && has_band)
        cells_check_band(&drawn, all, occupied, accuracy == TRIBOX_FAST ? &sum.fast : &sum.conservative);
    const bool is_of_layers = drawn.at.size[0] == drawn.grid.size[0] && drawn.at.size[1] == drawn.grid.size[1];
    if (is_of_layers && drawn.grid.size[2] <= 1 << 30) /* tribox_voxelize promises no more */
        check_layers(occupied);
}

/*
 * Asks for ids with numbers from anywhere, into memory that had anything and ends with a page. Fails where bits, ids or the report
 * are not as expected, or an id was written where no bit is.
 */
static void check_ids(void)
{
    const size_t cells = window_cells(), bytes = cells * sizeof(uint32_t);
    static uint32_t had[CELLS_MAX];
    static guarded pages;
    uint32_t *const ids = guarded_room(&pages, bytes), last = UINT32_MAX - (uint32_t)drawn.count;
    const uint32_t first = random_int(&r, 2) ? 0 : random_int(&r, 2) ? last : (uint32_t)random_below(&r, last);
    const int kind = random_int(&r, 4);
    const size_t middle = random_below(&r, drawn.count + 1), cut[] = {0, middle, drawn.count}, from = random_below(&r, 2);
    size_t set = 0;
    snprintf(doing, sizeof doing, "ids of %s, form %d, accuracy %d, axes %u, kernel %s", drawn.scene, (int)drawn.form,
             (int)drawn.options.accuracy, drawn.options.axes, drawn.options.kernel);
    for (size_t n = 0; n < cells; n++)
        ids[n] = had[n] = kind == 0 ? 0 : kind == 1 ? UINT32_MAX : kind == 2 ? first : (uint32_t)random_bits(&r);
    memset(occupied, 0, cells_words(&drawn) * sizeof *occupied);
    for (size_t n = 0; n < 2; n++) {
        const size_t part = n ^ from;
        const soup_or_mesh of = cells_part(&drawn, cut[part], cut[part + 1] - cut[part]);
        tribox_report report;
        assert_int_equal(
            CALL(voxelize_ids, &of, first + (uint32_t)cut[part], &drawn.grid, &drawn.at, &drawn.options, occupied, ids, &report),
            TRIBOX_OK);
        set += report.overlapping;
    }
    for (size_t n = 0; n < cells; n++) {
        const bool is_expected = is_set(all, n);
        const uint32_t id = is_expected ? first + lowest[n] : had[n];
        if (is_set(occupied, n) != is_expected || ids[n] != id)
            fail_msg("%s: cell %zu is %s with %u and not %u, first %u", doing, n, is_expected ? "expected" : "not expected",
                     (unsigned)ids[n], (unsigned)id, (unsigned)first);
    }
    assert_int_equal(set, bits_set(all, cells_words(&drawn)));
}

/* By EXACT in any form; or at any accuracy the lowest of those that have the cell alone. */
static void check_all_ids(unsigned axes)
{
    if (window_cells() > CELLS_MAX)
        return;
    for (drawn.form = drawn.is_double ? DOUBLES : SOUP; drawn.form < FORMS; drawn.form++) {
        choose(TRIBOX_EXACT, axes, random_int(&r, kernels));
        check_ids();
    }
    drawn.form = drawn.is_double ? DOUBLES : SOUP;
    if (drawn.is_double || random_int(&r, 8))
        return;
    choose((tribox_accuracy)random_int(&r, 3), (unsigned)random_int_between(&r, 1, AXIS_SETS), random_int(&r, kernels));
    expect(axes, false);
    check_ids();
}

/* What there is to say about the triangles and the window drawn. */
static void check(unsigned axes, bool is_within_fast)
{
    expect(axes, true);
    sum.runs++;
    sum.set += bits_set(all, cells_words(&drawn));
    for (int kernel = 0; kernel < kernels; kernel++)
        check_exact(axes, kernel);
    check_rounded(TRIBOX_CONSERVATIVE, axes, axes == TRIBOX_AXES_ALL);
    check_rounded(TRIBOX_FAST, axes, axes == TRIBOX_AXES_ALL && is_within_fast);
    check_all_ids(axes);
}

static bool has_started; /* a scene of the name that was asked for */

static bool start(const char *scene)
{
    r = random_named(args.seed, scene);
    memset(&sum, 0, sizeof sum);
    const bool is_asked = !args.scenes || !strcmp(args.scenes, scene);
    has_started |= is_asked;
    return is_asked;
}

static void print_sum(const char *scene)
{
    printf("%-24s %6zu runs, %zu asked, %zu set, CONSERVATIVE %zu more, FAST %zu more and %zu missing of %zu\n", scene, sum.runs,
           sum.asked, sum.set, sum.conservative.extra, sum.fast.extra, sum.fast.missed, sum.fast.asked);
    fflush(stdout);
    assert_true(sum.set > 0);
}

/* Those that the box normals are part of cost the oracle less: by others it is asked about every cell. */
static unsigned draw_axes(void)
{
    static const unsigned sets[] = {7, 7, 7, 7, 7, 7, 7, 7, 3, 3, 5, 1, 2, 4, 6};
    return sets[random_int(&r, (int)(sizeof sets / sizeof sets[0]))];
}

/* A kind of triangles, or of any kinds, or a mesh, in a kind of grids. */
static void try_kind(const char *scene, const grid_kind *grid, const triangle_kind *kind, bool is_mesh)
{
    const unsigned axes = draw_axes();
    const size_t few = grid->is_double ? 6 : 5, many = grid->is_double ? 60 : 200;
    const size_t count = 1 + random_below(&r, random_int(&r, 2) ? few : many);
    draw_grid_of_kind(&r, grid, !(axes & TRIBOX_AXES_BOX) ? CELLS_FOR_ALL : grid->is_double ? CELLS_OF_DOUBLES : CELLS_MAX, &drawn);
    if (is_mesh)
        put_mesh(&r, &drawn);
    else
        put_triangles(&r, kind, count, ASKED_MAX, &drawn);
    drawn.scene = scene;
    check(axes, kind && kind->is_within_fast && grid->is_within_fast);
}

CASE(test_kinds)
{
    const size_t floats = grid_kind_floats(), rounds = arguments_rounds(&args, PAIRS_A_ROUND);
    for (size_t s = 0; s <= triangle_kind_count(); s++) {
        const triangle_kind *const kind = s < triangle_kind_count() ? triangle_kind_at(s) : NULL;
        const char *const scene = kind ? kind->name : "mesh";
        if (!start(scene))
            continue;
        for (size_t k = 0; k < floats * rounds; k++)
            try_kind(scene, grid_kind_at(k % floats), kind, !kind);
        print_sum(scene);
    }
    for (size_t g = floats; g < grid_kind_count(); g++) {
        const char *const scene = grid_kind_at(g)->name;
        if (!start(scene))
            continue;
        for (size_t k = 0; k < 6 * rounds; k++)
            try_kind(scene, grid_kind_at(g), NULL, false);
        print_sum(scene);
    }
}

/* Grids of which no call has all cells, and of more than 2^31 words. */
static const struct large_grid {
    const char *name;
    bool is_double, has_layers; /* layers of few words: else windows are asked alone */
    tribox_grid grid;
    uint32_t window[3]; /* as many cells a side of a window that is not of whole layers */
} large_grids[] = {
    {"told by floats", false, true, {{0, 0, 0}, {1, 1, 1}, {192, 1024, 1 << 20}}, {40, 40, 5}},
    {"cells of many lengths", false, true, {{-70, -300, -0x1p17}, {0.75, 0.5, 0.25}, {192, 1024, 1 << 20}}, {40, 40, 5}},
    {"more layers than floats", false, true, {{0, 0, 0}, {1, 1, 1}, {64, 4096, 1 << 21}}, {20, 20, 5}},
    {"most layers", false, true, {{0, -32, 0}, {1, 1, 1}, {130, 256, 1 << 22}}, {9, 9, 5}},
    {"planes off a little", false, true, {{0, 0, -43230}, {1.1, 0.9, 0.66}, {256, 5000, 131000}}, {20, 20, 5}},
    {"planes off by much", false, true, {{0, 0, 0}, {0.7, 1.3, 0.7}, {70, 600, 1 << 21}}, {20, 20, 5}},
    {"long rows", false, true, {{0, 0, -0x1p19}, {1, 1, 1}, {65000, 3, 1 << 20}}, {70, 70, 5}},
    {"wide", false, false, {{0, 0, 0}, {1, 1, 1}, {1 << 22, 4096, 8192}}, {20, 20, 5}},
    {"long", false, false, {{0, 0, 0}, {1, 0.5, 1}, {4096, 1 << 22, 4096}}, {20, 20, 5}},
    {"wide and told by floats", false, false, {{-0x1p19, 0, 0}, {1, 1, 1}, {1 << 20, 1 << 20, 1 << 20}}, {40, 40, 5}},
    {"all long", false, false, {{-0x1p22, 0, -3}, {1, 0.7, 2}, {1 << 23, 1 << 22, 1 << 22}}, {12, 12, 5}},
    {"fine in the middle", false, false, {{-0x1p24, -8, -8}, {1, 1, 1}, {1 << 25, 16, 16}}, {130, 6, 6}},
    {"row", false, false, {{-16777216, 0, 0}, {1, 1, 1}, {33554431, 2, 2}}, {130, 2, 2}},
    {"tall, doubles", true, true, {{0, 0, -1e6}, {1, 0.1, 1}, {64, 70, UINT32_MAX}}, {70, 5, 5}},
    {"many words, doubles", true, true, {{0, 0, 0}, {1, 1, 0.125}, {130, 30, (uint32_t)1 << 31}}, {70, 5, 5}},
    {"wide, doubles", true, false, {{-1e9, 3, 0}, {0.3, 1, 1}, {UINT32_MAX, 90, 80}}, {70, 5, 5}},
    {"long, doubles", true, false, {{0, -1e9, 0}, {1, 0.7, 1}, {90, UINT32_MAX, 80}}, {70, 5, 5}},
    {"all long, doubles", true, false, {{-5, 1e6, -7}, {0.1, 1, 3}, {UINT32_MAX, UINT32_MAX, 4096}}, {70, 5, 5}},
};
enum { LARGE_GRIDS = sizeof large_grids / sizeof large_grids[0] };

/* Long on one axis at least, from zero on, about it or far away, where a cell has few floats. */
static struct large_grid draw_large_grid(void)
{
    static const double lengths[] = {1, 0.25, 0.1, 0.3, 0.7, 1.3, 1.9999999, 1.0000001};
    struct large_grid drawn_grid = {"drawn", random_int(&r, 2), false, .window = {130, 6, 6}};
    tribox_grid *const grid = &drawn_grid.grid;
    const int longest = random_int(&r, 3), way = random_int(&r, 3);
    const bool is_thin = random_int(&r, 2);
    for (int a = 0; a < 3; a++) {
        grid->size[a] = a == longest ? 1 << random_int_between(&r, 10, 24) : is_thin ? 4 : 1 << random_int_between(&r, 13, 16);
        grid->cell[a] = random_int(&r, 2) ? lengths[random_int(&r, 8)] : random_double(&r, 0.5, 2);
        grid->origin[a] = way == 0 ? -0.5 * grid->size[a] * grid->cell[a] : way == 1 ? 0 : random_double(&r, 1, 2) * 0x1p18;
    }
    return drawn_grid;
}

/* Layers of the window that begin 2^31 words behind the first of the grid, or twice that, or beside these. */
static void move_past_words(void)
{
    const uint64_t layer = ((uint64_t)drawn.grid.size[0] + 63) / 64 * drawn.grid.size[1];
    const uint64_t far = ((uint64_t)random_int_between(&r, 1, 2) << 31) / layer + (uint64_t)random_int(&r, 3);
    if (far && far - 1 + drawn.at.size[2] <= drawn.grid.size[2])
        drawn.at.first[2] = (uint32_t)(far - 1);
}

/* The tile that begins the window, which becomes it. */
static size_t tile_of_window(void)
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
static void check_bricks(size_t tile, tribox_accuracy accuracy, unsigned axes)
{
    const soup_or_mesh of = cells_all(&drawn);
    const tribox_tiles share = {TILE, tile, 1};
    const tribox_sink sink = {take, occupied};
    size_t starts[2];
    uint32_t list[CELLS_TRIANGLES];
    static guarded pages;
    void *const scratch = guarded_room(&pages, tribox_bricks_bytes(TILE));
    tribox_report report;
    choose(accuracy, axes, random_int(&r, kernels));
    snprintf(doing, sizeof doing, "bricks of %s", drawn.scene);
    memset(occupied, 0, cells_words(&drawn) * sizeof *occupied);
    assert_int_equal(CALL(tile_lists, &of, &drawn.grid, &share, &drawn.options, starts, NULL), TRIBOX_OK);
    assert_int_equal(CALL(tile_lists, &of, &drawn.grid, &share, &drawn.options, starts, list), TRIBOX_OK);
    assert_int_equal(CALL(bricks, &of, &drawn.grid, &share, starts, list, &drawn.options, scratch, &sink, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, bits_set(occupied, cells_words(&drawn)));
    cells_check(&drawn, 0, drawn.count, all, occupied);
}

/* A window of whole layers, of any cells, or a tile, whose bricks are asked too. */
static void try_large(const struct large_grid *from, int way)
{
    static const unsigned axes_sets[] = {7, 7, TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE};
    const unsigned axes = axes_sets[random_int(&r, 4)];
    size_t tile = SIZE_MAX;
    drawn.scene = from->name;
    drawn.is_double = from->is_double;
    drawn.form = from->is_double ? DOUBLES : SOUP;
    drawn.grid = from->grid;
    drawn.count = 0;
    cells_open(&drawn);
    const tribox_window whole = drawn.at;
    cells_draw_window(&r, &whole, way ? from->window : (const uint32_t[3]){UINT32_MAX, UINT32_MAX, 3}, &drawn.at);
    if (random_int(&r, 3) == 0)
        move_past_words();
    for (int a = 0; a < 2 && way == 0; a++) {
        drawn.at.first[a] = 0;
        drawn.at.size[a] = drawn.grid.size[a];
    }
    if (way == 0 && cells_words(&drawn) > WORDS_MAX)
        drawn.at.size[2] = 1;
    if (way == 2 && tribox_tile_count(drawn.grid.size, TILE) < SIZE_MAX / 2)
        tile = tile_of_window();
    put_triangles(&r, random_int(&r, 2) ? triangle_kind_at(0) : NULL, 12, ASKED_OF_LARGE, &drawn);
    check(axes, false);
    if (tile == SIZE_MAX)
        return;
    expect(axes, true);
    for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
        check_bricks(tile, (tribox_accuracy)accuracy, axes);
}

CASE(test_large)
{
    const size_t rounds = arguments_rounds(&args, PAIRS_A_ROUND);
    for (size_t n = 0; n <= LARGE_GRIDS; n++) {
        struct large_grid from = n < LARGE_GRIDS ? large_grids[n] : (struct large_grid){.name = "drawn"};
        if (!start(from.name))
            continue;
        for (size_t round = 0; round < (n < LARGE_GRIDS ? 1 : 10) * rounds; round++)
            for (int way = from.has_layers ? 0 : 1; way < 3; way++) {
                if (n == LARGE_GRIDS)
                    from = draw_large_grid();
                try_large(&from, way);
            }
        print_sum(from.name);
    }
}

/*
 * About `resolution` cells along the longest side. Kind 0: cubes from the lowest corner of the mesh; 1: a length for each axis;
 * 2: the origin is a vertex, so that a part lies outside; 3: cells that end at both ends of the bounds; 4: doubles, of a mesh 20 m
 * long in UTM coordinates.
 */
static void draw_grid_about(const mesh *m, const tribox_box *bounds, int resolution, int kind, double shift[3], double *scale)
{
    static const double place[3] = {557820, 5108010, 700};
    double longest = 0;
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, bounds->hi[a] - bounds->lo[a]);
    const size_t vertex = random_below(&r, m->count);
    *scale = kind == 4 ? 20 / longest : 1;
    for (int a = 0; a < 3; a++) {
        const double extent = fmax(bounds->hi[a] - bounds->lo[a], longest / resolution) * *scale;
        const int cells = kind == 1 ? random_int_between(&r, 1, resolution) : resolution;
        const double cell = kind == 1 || kind == 3 ? extent / cells : longest * *scale / resolution;
        shift[a] = kind == 4 ? place[a] - bounds->lo[a] * *scale : 0;
        drawn.grid.cell[a] = kind == 4 ? cell : (double)(float)cell;
        drawn.grid.size[a] = (uint32_t)(kind == 2 ? random_int_between(&r, 1, resolution) : fmin(ceil(extent / cell), cells));
        drawn.grid.origin[a] = kind == 2 ? (double)m->coordinate[vertex % 3][a][vertex] : bounds->lo[a] * *scale + shift[a];
    }
}

/* Triangles from any one on, until the oracle has enough to do, in a window about the first of them. */
static void try_part_of_mesh(const mesh *m, const double shift[3], double scale)
{
    const size_t first = random_below(&r, m->count);
    cells_open(&drawn);
    drawn.count = 0;
    for (size_t i = 0, cost = 0; i < m->count && drawn.count < 1000 && cost < ASKED_MAX; i++) {
        double u[3][3];
        for (int n = 0; n < 9; n++)
            u[n / 3][n % 3] = (double)m->coordinate[n / 3][n % 3][(first + i) % m->count] * scale + shift[n % 3];
        for (int a = 0; a < 3 && i == 0; a++) {
            const double at = (u[0][a] - drawn.grid.origin[a]) / drawn.grid.cell[a] - 20, last = drawn.grid.size[a] - 1.0;
            drawn.at.first[a] = (uint32_t)fmin(fmax(at, 0), last);
            drawn.at.size[a] = (uint32_t)fmin(40, last + 1 - drawn.at.first[a]);
        }
        cells_put(&drawn, u);
        cost += cells_cost(&drawn, drawn.count - 1, TRIBOX_AXES_ALL);
    }
    check(TRIBOX_AXES_ALL, true);
}

static void try_mesh(const arguments *given, const char *name, const mesh *m)
{
    static const int resolutions[] = {7, 32, 64, 130, 300};
    const tribox_box bounds = mesh_bounds(m);
    (void)given;
    start(name);
    for (int k = 0; k < 5 * 5; k++) {
        double shift[3], scale;
        drawn.scene = name;
        drawn.is_double = k % 5 == 4;
        drawn.form = drawn.is_double ? DOUBLES : SOUP;
        draw_grid_about(m, &bounds, resolutions[k / 5], k % 5, shift, &scale);
        for (size_t n = 0; n < 2; n++)
            try_part_of_mesh(m, shift, scale);
    }
    print_sum(name);
}

CASE(test_real_meshes) { real_meshes_try(&args, try_mesh); }

/* The cell oracle is trusted as far as the two other oracles agree with it. */
CASE(test_judge)
{
    size_t overlaps = 0, asked = 0;
    start("judge");
    for (size_t k = 0; k < args.pairs / 10; k++) {
        uint32_t at[3];
        double u[3][3];
        if (k % 20 == 0)
            draw_grid_of_kind(&r, grid_kind_at(k / 20 % grid_kind_count()), 400, &drawn);
        draw_triangle(&r, triangle_kind_at(k % triangle_kind_count()), &drawn, u);
        for (int a = 0; a < 3; a++)
            at[a] = (uint32_t)random_below(&r, drawn.grid.size[a]);
        pair_f64 pair = {.box = cells_box(&drawn, at)};
        for (int n = 0; n < 9; n++)
            pair.u[n / 3][n % 3] = isfinite(u[n / 3][n % 3]) ? u[n / 3][n % 3] : 0;
        const cell_oracle t = cell_oracle_make((const double(*)[3])pair.u);
        const oracle_axes truth = oracle_separating_gmp(&pair);
        for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++)
            assert_int_equal(cell_oracle_overlaps(&t, &pair.box, axes), oracle_overlaps(truth, axes));
        if (!drawn.is_double) /* longer numbers take long */
            assert_int_equal(cell_oracle_overlaps(&t, &pair.box, TRIBOX_AXES_ALL), oracle_clip(&pair));
        overlaps += oracle_overlaps(truth, TRIBOX_AXES_ALL);
        asked++;
    }
    printf("cell oracle asked about %zu pairs, %zu overlap\n", asked, overlaps);
    assert_in_range(overlaps, asked / 100, asked - asked / 100);
}

/*
 * Slivers far along x, where float moves a vertex by a notable part of their height, which turns their planes: by box normals and
 * plane nothing but the doubles decides.
 */
CASE(test_planes_of_slivers)
{
    start("slivers");
    drawn.scene = "slivers";
    drawn.is_double = true;
    drawn.grid = (tribox_grid){{0.3, -7, 100}, {0.1, 0.1, 0.1}, {60000, 2, 2}};
    cells_open(&drawn);
    for (size_t round = 0; round < 50 * arguments_rounds(&args, 100000); round++) {
        for (drawn.count = 0; drawn.count < 10;) {
            double u[3][3];
            const double at = random_double(&r, 59000, 59990), height = ldexp(1, random_int_between(&r, -13, -5));
            for (int a = 0; a < 3; a++) {
                const double from = a ? random_double(&r, -1, 3) : at, to = a ? random_double(&r, -1, 3) : at + 7;
                u[0][a] = cells_place(&drawn, a, from);
                u[1][a] = cells_place(&drawn, a, to);
                u[2][a] = cells_place(&drawn, a, (from + to) / 2 + height * random_double(&r, -1, 1));
            }
            cells_put(&drawn, u);
        }
        choose(TRIBOX_EXACT, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE, random_int(&r, kernels));
        cells_expect(&drawn, 0, drawn.count, drawn.options.axes, expected);
        cells_ask(&drawn, 0, drawn.count, occupied);
        cells_check(&drawn, 0, drawn.count, expected, occupied);
    }
}

CASE(test_name_of_scene) { assert_true(has_started || args.named_case); }

PROGRAM(RUN(test_judge), RUN(test_kinds), RUN(test_large), RUN(test_planes_of_slivers), RUN(test_real_meshes),
        RUN(test_name_of_scene))
