/*
 * test_tall.c - grids of more than 2^31 words, and triangles that go far beyond the few layers, window or tiles that are asked for:
 * tall, long and wide ones, flat ones, lines and bricks. Each cell is compared with tribox_overlap, and words lie between guards.
 * Fills are not asked: they refuse a grid of more than 2^31 words (tests/scale).
 */
#include "occupancy.h"

#include <math.h>

#include "common/harness.h"
#include "common/soup_or_mesh.h"
#include "common/window_bits.h"
#include "common/contact.h"
#include "triangle_kinds.h"
#include "window_f64.h"

enum {
    TRIANGLES = 12,
    PAIRS_A_ROUND = 10000,
    FEW_PAIRS = 40000,
    WORDS_MAX = 1 << 16,
    CELLS_MAX = 65000,
    TILE = 64,
    WIDEST = 10000
};

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

/* What is asked: of floats, or of doubles. */
typedef struct tall_case {
    const char *name;
    bool is_double;
    tribox_grid grid;
    tribox_window w;
    triangle_list triangles;
    double corners[TRIANGLES][3][3]; /* the same triangles in doubles */
    tribox_options options;
} tall_case;

static tall_case drawn;
static uint64_t expected[WORDS_MAX], layer_words[WORDS_MAX];

static size_t words_of(const tribox_window *w) { return tribox_window_words(w->size); }

static void tell(const tall_case *c)
{
    snprintf(doing, sizeof doing, "%s: cells %u %u %u, %u x %u x %u, accuracy %d, axes %u, kernel %s", c->name,
             (unsigned)c->w.first[0], (unsigned)c->w.first[1], (unsigned)c->w.first[2], (unsigned)c->w.size[0],
             (unsigned)c->w.size[1], (unsigned)c->w.size[2], (int)c->options.accuracy, c->options.axes, c->options.kernel);
}

static soup_or_mesh asked_of(const tall_case *c)
{
    return (soup_or_mesh){triangle_list_soup(&c->triangles), mesh_of_corners(c->corners, TRIANGLES, 8), c->is_double};
}

/* The planes of the window, from the boxes of its cells. */
static double planes[3][CELLS_MAX + 1];

static void read_planes(const tall_case *c)
{
    for (int a = 0; a < 3; a++)
        for (uint32_t n = 0; n <= c->w.size[a]; n++) {
            const bool is_last = n == c->w.size[a];
            uint32_t at[3] = {c->w.first[0], c->w.first[1], c->w.first[2]};
            at[a] += n - is_last;
            const tribox_box box = tribox_grid_cell(&c->grid, at[0], at[1], at[2]);
            planes[a][n] = is_last ? box.hi[a] : box.lo[a];
        }
}

/* Cells of the window, from `first` to before `end`. */
typedef struct part {
    uint32_t first[3], end[3];
} part;

/* Those that the box of a triangle touches, each plane looked at. */
static part touched(const tall_case *c, size_t t)
{
    part p;
    for (int a = 0; a < 3; a++) {
        const double u[3] = {c->corners[t][0][a], c->corners[t][1][a], c->corners[t][2][a]};
        const double least = fmin(fmin(u[0], u[1]), u[2]), most = fmax(fmax(u[0], u[1]), u[2]);
        p.first[a] = c->w.size[a];
        p.end[a] = 0;
        for (uint32_t n = 0; n < c->w.size[a]; n++)
            if (planes[a][n] <= most && planes[a][n + 1] >= least) {
                p.first[a] = n < p.first[a] ? n : p.first[a];
                p.end[a] = n + 1;
            }
    }
    return p;
}

static void expect_row(const tall_case *c, size_t t, const part *p, const uint32_t at[3])
{
    const tribox_mesh mesh = mesh_of_corners(c->corners[t], 1, 8);
    const tribox_options options = {.axes = c->options.axes};
    for (uint32_t i = p->first[0]; i < p->end[0]; i++) {
        const tribox_box box = {{planes[0][i], planes[1][at[1]], planes[2][at[2]]},
                                {planes[0][i + 1], planes[1][at[1] + 1], planes[2][at[2] + 1]}};
        uint64_t mask;
        assert_int_equal(tribox_mesh_overlap(&mesh, &box, &options, &mask, NULL), TRIBOX_OK);
        if (mask & 1)
            window_put(c->w.size, expected, i, at[1], at[2], true);
    }
}

/* Returns how many cells overlap. All axes asked begin with the box normals, so others do not. */
static size_t expect(const tall_case *c)
{
    read_planes(c);
    memset(expected, 0, words_of(&c->w) * sizeof *expected);
    for (size_t t = 0; t < TRIANGLES; t++) {
        const part p = touched(c, t);
        uint32_t at[3];
        if (p.first[0] >= p.end[0])
            continue;
        for (at[2] = p.first[2]; at[2] < p.end[2]; at[2]++)
            for (at[1] = p.first[1]; at[1] < p.end[1]; at[1]++)
                expect_row(c, t, &p, at);
    }
    return occupancy_count(expected, words_of(&c->w));
}

/* EXACT has the cells that overlap, CONSERVATIVE at least these, and no call others than cells. */
static void check(const tall_case *c, const uint64_t *words)
{
    const uint32_t rest = c->w.size[0] % 64;
    for (size_t n = 0; n < words_of(&c->w); n++) {
        const uint64_t cells = rest && (n + 1) % window_row(c->w.size) == 0 ? ~(~UINT64_C(0) << rest) : ~UINT64_C(0);
        const uint64_t lost = c->options.accuracy == TRIBOX_FAST ? 0 : expected[n] & ~words[n];
        const uint64_t extra = words[n] & ~(c->options.accuracy == TRIBOX_EXACT ? expected[n] : cells);
        if (lost | extra)
            fail_msg("%s: word %zu lacks %#llx, has %#llx too many", doing, n, (unsigned long long)lost, (unsigned long long)extra);
    }
}

static tribox_status voxelize(const tall_case *c, const tribox_window *w, uint64_t *words, tribox_report *report)
{
    const soup_or_mesh of = asked_of(c);
    memset(words, 0, words_of(w) * sizeof *words);
    return CALL(voxelize, &of, &c->grid, w, &c->options, words, report);
}

/* Layers have the bits of the grid at every accuracy: so each alone has those of all. */
static void check_layers(const tall_case *c, const uint64_t *words)
{
    tribox_window w = c->w;
    const size_t layer = window_row(w.size) * w.size[1];
    w.size[2] = 1;
    for (uint32_t k = 0; k < c->w.size[2]; k++, w.first[2]++) {
        assert_int_equal(voxelize(c, &w, layer_words, NULL), TRIBOX_OK);
        if (memcmp(layer_words, words + k * layer, layer * sizeof *words))
            fail_msg("%s: layer %u alone differs", doing, (unsigned)w.first[2]);
    }
}

/* First against the page before, then against the one after. */
static void ask(const tall_case *c, bool has_layers)
{
    const size_t bytes = words_of(&c->w) * sizeof(uint64_t);
    const guarded g = guarded_make(bytes);
    tell(c);
    for (int side = 0; side < 2; side++) {
        uint64_t *const words = side ? guarded_tail(g, bytes) : (void *)g.first;
        tribox_report report;
        assert_int_equal(voxelize(c, &c->w, words, &report), TRIBOX_OK);
        assert_int_equal(report.overlapping, occupancy_count(words, words_of(&c->w)));
        check(c, words);
        if (side && has_layers)
            check_layers(c, words);
    }
    guarded_free(g);
}

/* By every kernel, at every accuracy. Returns the cells that overlap. */
static size_t ask_all(tall_case *c, bool has_layers)
{
    const size_t set = expect(c);
    for (int k = 0; k < kernels; k++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            c->options.kernel = names[k];
            c->options.accuracy = (tribox_accuracy)accuracy;
            ask(c, has_layers);
        }
    return set;
}

static double place(const tall_case *c, int a, double p)
{
    return c->is_double ? window_f64_plane(&c->grid, a, p) : (double)grid_planes_place(&c->grid, a, p);
}

/*
 * Through the window: on each axis within one cell, over a few, over more than float takes at a time, or over all of the grid, but
 * on x and y no more than `widest` to either side. The point that is in the window lies within a cell, or on planes.
 */
static void draw_triangles(random_source *r, tall_case *c, double widest)
{
    c->triangles.count = 0;
    for (size_t t = 0; t < TRIANGLES; t++) {
        const double one = random_double(r, 0.2, 1.5), other = random_double(r, 0.1, 1.5);
        const bool is_on_planes = random_int(r, 6) == 0;
        for (int a = 0; a < 3; a++) {
            const double all = 0.5 * c->grid.size[a], far = a == 2 || all < widest ? all : widest;
            const double lengths[] = {0.1, 3, 28, far}, most = lengths[random_int(r, 4)];
            const double within = is_on_planes ? 0 : random_double(r, 0.4, 0.6);
            const double in = c->w.first[a] + (double)random_below(r, c->w.size[a]) + within;
            double by[3] = {random_double(r, -most, most), random_double(r, -most, most)};
            by[2] = -one * by[0] - other * by[1];
            for (int j = 0; j < 3; j++)
                c->corners[t][j][a] = place(c, a, in + by[j]);
        }
        float u[3][3];
        for (int n = 0; n < 9; n++)
            u[n / 3][n % 3] = (float)c->corners[t][n / 3][n % 3];
        triangle_list_put(&c->triangles, (const_vertices)u);
    }
}

/* Of every shape, from the first layers to the last; narrow where n has a bit for the axis. */
static void put_by_hand(tall_case *c)
{
    c->triangles.count = 0;
    for (size_t t = 0; t < TRIANGLES; t++) {
        float u[3][3];
        for (int a = 0; a < 3; a++) {
            const uint32_t size = c->grid.size[a], beside = (uint32_t)(2 * t) % size;
            const double from = a == 2 ? 0 : beside, most = a == 2 ? size - 1 : size < 80 ? size / 2 : 40;
            const double wide[3] = {0.5, most + 0.5, 0.4 * most + 0.5}, narrow[3] = {0.3, 0.7, 0.5};
            const double cell = a == 2 ? c->w.first[a] : beside;
            for (int j = 0; j < 3; j++) {
                c->corners[t][j][a] = place(c, a, t >> a & 1 ? cell + narrow[j] : from + wide[j]);
                u[j][a] = (float)c->corners[t][j][a];
            }
        }
        triangle_list_put(&c->triangles, (const_vertices)u);
    }
}

static void draw_axes(random_source *r, tall_case *c)
{
    static const unsigned axes[] = {0, 0, TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE};
    c->options = (tribox_options){.axes = axes[random_int(r, 4)]};
}

/* All of the grid. */
static void open_grid(tall_case *c, const tall_grid *from)
{
    c->name = from->name;
    c->is_double = from->is_double;
    c->grid = from->grid;
    memset(c->w.first, 0, sizeof c->w.first);
    memcpy(c->w.size, c->grid.size, sizeof c->w.size);
}

/* `length` cells of an axis at either end, anywhere, or the first that lie 2^31 words behind the first layer, or next to them. */
static void put_span(random_source *r, const tall_case *c, int a, uint32_t length, tribox_window *w)
{
    const uint32_t size = c->grid.size[a];
    const uint64_t layer = ((uint64_t)c->grid.size[0] + 63) / 64 * c->grid.size[1], far = (uint64_t)random_int_between(r, 1, 2)
                                                                                          << 31;
    w->size[a] = length < size ? length : size;
    const uint32_t last = size - w->size[a], anywhere = (uint32_t)random_below(r, (size_t)last + 1);
    const int way = random_int(r, 6);
    w->first[a] = way == 0 ? 0 : way == 1 ? last : anywhere;
    if (a == 2 && way > 3)
        w->first[2] = far / layer < last ? (uint32_t)(far / layer) + (uint32_t)random_int(r, 2) : last;
}

/* The layers that begin 2^31 words behind the first, and those about them. */
CASE(test_by_hand)
{
    for (size_t n = 0; n < GRIDS && !grids[n].is_double; n++)
        for (uint32_t step = 0; step < 4 && grids[n].has_layers; step++) {
            open_grid(&drawn, &grids[n]);
            const uint32_t layer = (drawn.grid.size[0] + 63) / 64 * drawn.grid.size[1];
            drawn.w.size[2] = 1;
            drawn.w.first[2] = step == 3 ? drawn.grid.size[2] - 1 : (UINT32_C(1) << 31) / layer - 1 + step;
            put_by_hand(&drawn);
            drawn.options = (tribox_options){0};
            assert_true(ask_all(&drawn, true) > TRIANGLES);
        }
}

/* Windows of whole layers, or of any cells. */
static void check_grid(random_source *r, const tall_grid *from, bool is_of_layers)
{
    const size_t rounds = arguments_rounds(&args, PAIRS_A_ROUND);
    size_t set = 0;
    for (size_t round = 0; round < rounds; round++) {
        open_grid(&drawn, from);
        for (int a = is_of_layers ? 2 : 0; a < 3; a++)
            put_span(r, &drawn, a, (uint32_t)random_int_between(r, 1, is_of_layers ? 3 : from->window[a]), &drawn.w);
        if (words_of(&drawn.w) > WORDS_MAX)
            drawn.w.size[2] = 1;
        draw_triangles(r, &drawn, INFINITY);
        draw_axes(r, &drawn);
        set += ask_all(&drawn, is_of_layers);
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
static size_t tile_of(tall_case *c)
{
    size_t tile = 0;
    for (int a = 2; a >= 0; a--) {
        const uint32_t along = c->grid.size[a] / TILE + (c->grid.size[a] % TILE != 0), at = c->w.first[a] / TILE;
        c->w.first[a] = at * TILE;
        c->w.size[a] = c->grid.size[a] - at * TILE < TILE ? c->grid.size[a] - at * TILE : TILE;
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
            cell[a] = 8 * at[a] + brick[a] - drawn.w.first[a];
        if (bits[n / 64] >> n % 64 & 1)
            window_put(drawn.w.size, words, cell[0], cell[1], cell[2], true);
    }
    return 0;
}

/* The list of a tile, and its cells from bricks. */
static void ask_bricks(const tall_case *c, size_t tile, uint64_t *words)
{
    const soup_or_mesh of = asked_of(c);
    const tribox_tiles one = {TILE, tile, 1};
    const tribox_sink sink = {take, words};
    size_t starts[2];
    uint32_t list[TRIANGLES];
    const size_t bytes = tribox_bricks_bytes(TILE);
    const guarded g = guarded_make(bytes);
    void *const scratch = guarded_tail(g, bytes);
    tribox_report report;
    memset(words, 0, words_of(&c->w) * sizeof *words);
    assert_int_equal(CALL(tile_lists, &of, &c->grid, &one, &c->options, starts, NULL), TRIBOX_OK);
    assert_int_equal(CALL(tile_lists, &of, &c->grid, &one, &c->options, starts, list), TRIBOX_OK);
    assert_int_equal(CALL(bricks, &of, &c->grid, &one, starts, list, &c->options, scratch, &sink, &report), TRIBOX_OK);
    guarded_free(g);
    assert_int_equal(report.overlapping, occupancy_count(words, words_of(&c->w)));
}

/* Sizes of powers of two, and cells of any length from zero on or about it, in float or double. */
static void draw_grid(random_source *r, tall_case *c)
{
    c->name = "drawn";
    c->is_double = random_int(r, 2);
    for (int a = 0; a < 3; a++) {
        c->grid.size[a] = (uint32_t)1 << random_int_between(r, 13, 20);
        c->grid.cell[a] = random_int(r, 2) ? 0.1 : random_double(r, 0.5, 2);
        c->grid.origin[a] = random_int(r, 2) ? 0 : -0.5 * c->grid.size[a] * c->grid.cell[a];
    }
}

/* A tile anywhere in such grids, by one kernel at every accuracy. Triangles cross few of the tiles that lists look at. */
CASE(test_bricks)
{
    static uint64_t words[TILE * TILE];
    random_source r = random_named(args.seed, "tall bricks");
    for (size_t round = 0; round < GRIDS * arguments_rounds(&args, FEW_PAIRS); round++) {
        if (random_int(&r, 2))
            draw_grid(&r, &drawn);
        else
            open_grid(&drawn, &grids[round % GRIDS]);
        if (tribox_tile_count(drawn.grid.size, TILE) == SIZE_MAX) /* on small machines */
            continue;
        for (int a = 0; a < 3; a++)
            put_span(&r, &drawn, a, 1, &drawn.w);
        const size_t tile = tile_of(&drawn);
        draw_triangles(&r, &drawn, WIDEST);
        draw_axes(&r, &drawn);
        drawn.options.kernel = names[random_int(&r, kernels)];
        expect(&drawn);
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            drawn.options.accuracy = (tribox_accuracy)accuracy;
            tell(&drawn);
            ask_bricks(&drawn, tile, words);
            check(&drawn, words);
        }
    }
}

PROGRAM(RUN(test_by_hand), RUN(test_layers), RUN(test_windows), RUN(test_bricks))
