/*
 * test_classes.c - triangles whose bounding boxes are 1 to 33 cells long, each length on each axis with each on the others: where
 * one way of the library ends and the next begins, at the ends of words, across the sides of the grid and of its layers.
 *
 * A soup holds one of them or a few over and over, or many of all lengths. EXACT is right from every kernel and counts each cell
 * once; CONSERVATIVE never misses; CONSERVATIVE and FAST err within their band alone; and at every accuracy layers have the bits of
 * the whole, which depend neither on the order of the triangles nor on how often they come.
 */
#include "cells.h"

#include <math.h>

#include "common/harness.h"
#include "common/contact.h"
#include "grid_kinds.h"

enum {
    PAIRS_A_ROUND = 10000, /* after LENGTHS rounds every combination of lengths has been asked about */
    MIXED_A_ROUND = 10,    /* soups of all lengths */
    SPECKS_A_ROUND = 100,  /* soups of a tiny triangle */
    OWN_MAX = 3,           /* triangles of other soups that differ */
    LARGE = 2000,          /* cells of a bounding box: soups of larger ones are small */
    ASKED_MAX = 10000,     /* cells that the oracle is asked about in a soup of all lengths */
    WORDS_MAX = 4096       /* of a grid */
};

static const int lengths[] = {1, 2, 3, 4, 5, 8, 9, 31, 32, 33};
enum { LENGTHS = sizeof lengths / sizeof lengths[0], SHORT_LENGTHS = LENGTHS - 3 };

/* Of a soup: about the lanes of a kernel and multiples of them. */
static const size_t counts[] = {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 63, 64, 65, 200};
enum { COUNTS = sizeof counts / sizeof counts[0], SMALL_COUNTS = COUNTS - 4 };

typedef struct test_run {
    random_source r;
    cells_case own, all; /* the triangles, and these over and over */
    uint64_t expected[WORDS_MAX], occupied[WORDS_MAX], other[WORDS_MAX];
    size_t soups, asked, set;
    tally conservative, fast;
} test_run;

/* Cells from `first` on; those below 0 or past the end lie outside the grid. */
typedef struct cell_span {
    int first, length;
} cell_span;

/* The layers in parts, against the bits of the whole. */
static void check_layers(test_run *t, const uint64_t *whole)
{
    const uint32_t size = t->all.grid.size[2];
    const size_t words = cells_words(&t->all), layer = words / size;
    size_t set = 0;
    memset(t->other, 0, words * sizeof *t->other);
    for (uint32_t first = 0, layers; first < size; first += layers) {
        layers = 1 + (uint32_t)random_int(&t->r, (int)(size - first));
        t->all.at.first[2] = first;
        t->all.at.size[2] = layers;
        set += cells_add(&t->all, 0, t->all.count, t->other + first * layer);
    }
    cells_open(&t->all);
    if (memcmp(t->other, whole, words * sizeof *whole) || set != cells_count(whole, words))
        fail_msg("%s: layers have or count other bits than the whole", doing);
}

static void check_exact(test_run *t)
{
    const size_t bytes = cells_words(&t->all) * sizeof *t->expected;
    cells_ask(&t->all, 0, t->all.count, t->occupied);
    cells_check(&t->all, 0, t->all.count, t->expected, t->occupied);
    check_layers(t, t->occupied);
    if (cells_add(&t->all, 0, t->all.count, t->occupied) || memcmp(t->occupied, t->expected, bytes))
        fail_msg("%s: asked again it sets more cells", doing);
}

static void check_rounded(test_run *t, bool has_band)
{
    t->own.options = t->all.options;
    cells_ask(&t->own, 0, t->own.count, t->other);
    cells_ask(&t->all, 0, t->all.count, t->occupied);
    if (memcmp(t->other, t->occupied, cells_words(&t->all) * sizeof *t->other))
        fail_msg("%s: copies of the triangles change cells", doing);
    check_layers(t, t->occupied);
    if (has_band)
        cells_check_band(&t->own, t->expected, t->occupied, t->all.options.accuracy == TRIBOX_FAST ? &t->fast : &t->conservative);
}

static void check_soup(test_run *t, bool is_within_fast)
{
    t->asked += cells_expect(&t->own, 0, t->own.count, TRIBOX_AXES_ALL, t->expected);
    t->soups++;
    t->set += cells_count(t->expected, cells_words(&t->own));
    for (int kernel = 0; kernel < kernels; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            t->all.options = (tribox_options){.accuracy = (tribox_accuracy)accuracy, .kernel = names[kernel]};
            if (accuracy == TRIBOX_EXACT)
                check_exact(t);
            else
                check_rounded(t, accuracy == TRIBOX_CONSERVATIVE || is_within_fast);
        }
}

/* A number in a cell: on its planes, in its middle or anywhere, and often the float beside that. */
static double draw_in_cell(random_source *r, const cells_case *c, int a, int cell)
{
    static const double part[] = {0, 0, 0.5, 1};
    const int n = random_int(r, 8);
    const float at = (float)cells_place(c, a, cell + (n < 4 ? part[n] : random_double(r, 0, 1)));
    if (at == 0 && random_int(r, 2)) /* edges of next to no length: there floats are fine enough */
        return (double)nearest_float(ldexp(random_double(r, -1, 1), -random_int_between(r, 30, 70)) * c->grid.cell[a]);
    return (double)(random_int(r, 2) ? at : nudged(r, at, 1));
}

/* Of the vertices, in any order, one lies in the first cell of each span, one in the last and one between. */
static void draw_triangle(random_source *r, const cells_case *c, const cell_span span[3], double u[3][3])
{
    const int thin = random_int(r, 6);
    for (int a = 0; a < 3; a++) {
        const int *const vertex = permutations[random_int(r, ORDERS)];
        const int last = span[a].first + span[a].length - 1;
        const int cell[3] = {span[a].first, last, random_int_between(r, span[a].first, last)};
        for (int j = 0; j < 3; j++)
            u[vertex[j]][a] = draw_in_cell(r, c, a, cell[j]);
        if (span[a].length == 1 && random_int(r, 4) == 0)
            u[0][a] = u[1][a] = u[2][a];
    }
    const double along = thin == 0 ? random_double(r, 0, 1) : 1;
    for (int a = 0; thin < 2 && a < 3; a++) /* a cap or a needle */
        u[2][a] = (double)nudged(r, nearest_float(u[0][a] + along * (u[1][a] - u[0][a])), random_int(r, 2) ? 1 : 100);
}

/* Room for a span within the grid, or across one of its sides or both. x begins or ends about the ends of halves of words. */
static cell_span place_span(random_source *r, int a, int length, uint32_t *size)
{
    const int border = a == 0 ? 32 * random_int(r, 3) : 0, beside = random_int_between(r, 0, 3);
    cell_span span = {border + beside - (border && random_int(r, 2) ? length + 1 : 1), length};
    int end = span.first + length + random_int_between(r, 0, 2);
    if (random_int(r, 4) == 0)
        span.first = -random_int_between(r, 1, length);
    if (random_int(r, 4) == 0)
        end = span.first + random_int_between(r, 1, length);
    *size = (uint32_t)(end < 1 ? 1 : end);
    return span;
}

/* Returns how many cells the oracle will be asked about. */
static size_t put_triangle(test_run *t, const cell_span span[3])
{
    double u[3][3];
    draw_triangle(&t->r, &t->own, span, u);
    cells_put(&t->own, u);
    return cells_cost(&t->own, t->own.count - 1, TRIBOX_AXES_ALL);
}

/* Begins with any of them, and may end with copies that have a number that is not finite: these overlap nothing. */
static void repeat_triangles(test_run *t, size_t count)
{
    static const float numbers[] = {(float)NAN, INFINITY, -INFINITY};
    const size_t start = (size_t)random_int(&t->r, (int)t->own.count), end = count + (size_t)random_int(&t->r, 4);
    t->all.grid = t->own.grid;
    t->all.at = t->own.at;
    t->own.scene = t->all.scene;
    for (t->all.count = 0; t->all.count < end;) {
        double u[3][3];
        memcpy(u, t->own.u[(start + t->all.count) % t->own.count], sizeof u);
        if (t->all.count >= count)
            u[random_int(&t->r, 3)][random_int(&t->r, 3)] = (double)numbers[random_int(&t->r, 3)];
        cells_put(&t->all, u);
    }
}

/* A soup of triangles over these spans of cells. */
static void try_lengths(test_run *t, const int length[3])
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(&t->r, (int)grid_kind_floats()));
    const size_t count = counts[random_int(&t->r, length[0] * length[1] * length[2] > LARGE ? SMALL_COUNTS : COUNTS)];
    cell_span span[3];
    uint32_t size[3];
    for (int a = 0; a < 3; a++)
        span[a] = place_span(&t->r, a, length[a], &size[a]);
    draw_grid_of_size(&t->r, kind, size, &t->own);
    assert_true(cells_words(&t->own) <= WORDS_MAX);
    const size_t own = count < OWN_MAX ? count : (size_t)random_int_between(&t->r, 1, OWN_MAX);
    for (t->own.count = 0; t->own.count < own;)
        put_triangle(t, span);
    repeat_triangles(t, count);
    check_soup(t, kind->is_within_fast);
}

/* A soup of triangles of all lengths. */
static void try_mixed(test_run *t)
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(&t->r, (int)grid_kind_floats()));
    const size_t own = counts[random_int(&t->r, COUNTS)];
    const uint32_t size[3] = {(uint32_t)random_int_between(&t->r, 30, 130), (uint32_t)random_int_between(&t->r, 8, 35),
                              (uint32_t)random_int_between(&t->r, 8, 35)};
    size_t cost = 0;
    draw_grid_of_size(&t->r, kind, size, &t->own);
    for (t->own.count = 0; t->own.count < own && cost < ASKED_MAX;) {
        const int reach = random_int(&t->r, 4) ? SHORT_LENGTHS : LENGTHS;
        cell_span span[3];
        for (int a = 0; a < 3; a++) {
            span[a].length = lengths[random_int(&t->r, reach)];
            span[a].first = random_int_between(&t->r, -2, (int)t->own.grid.size[a] + 1);
        }
        cost += put_triangle(t, span);
    }
    repeat_triangles(t, t->own.count + (size_t)random_int(&t->r, 40));
    check_soup(t, kind->is_within_fast);
}

/* A triangle far smaller than a cell, about a corner of cells at zero, where floats are fine enough for that. */
static void try_speck(test_run *t)
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(&t->r, (int)grid_kind_floats()));
    const uint32_t size[3] = {5, 5, 5};
    draw_grid_of_size(&t->r, kind, size, &t->own);
    double u[3][3];
    for (int a = 0; a < 3; a++) {
        const int exponent = -random_int(&t->r, 130);
        const double cell = t->own.grid.cell[a];
        t->own.grid.origin[a] = -ldexp(cell, random_int_between(&t->r, 0, 2));
        if (!isfinite(cells_plane(&t->own.grid, a, size[a])))
            return;
        for (int j = 0; j < 3; j++) {
            const double at = ldexp(random_double(&t->r, -1, 1), exponent) * cell;
            const int n = random_int(&t->r, 8);
            u[j][a] = (double)(n > 2 ? nearest_float(at) : n > 1 ? copysignf(0x1p-149f, (float)at) : 0);
        }
    }
    t->own.count = 0;
    cells_put(&t->own, u);
    repeat_triangles(t, counts[random_int(&t->r, SMALL_COUNTS)]);
    check_soup(t, false);
}

static test_run *start(const char *scene)
{
    static test_run run;
    memset(&run, 0, sizeof run);
    run.all.scene = scene;
    run.r = random_named(args.seed, scene);
    return &run;
}

static void print_tally(const test_run *t)
{
    printf("%zu soups, %zu cells asked, %zu set; CONSERVATIVE sets %zu more; FAST misses %zu of %zu and sets %zu more\n", t->soups,
           t->asked, t->set, t->conservative.extra, t->fast.missed, t->fast.asked, t->fast.extra);
    assert_true(t->set > 0);
}

CASE(test_lengths)
{
    test_run *const t = start("lengths");
    for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++)
        for (size_t y = 0; y < LENGTHS; y++)
            for (size_t z = 0; z < LENGTHS; z++)
                try_lengths(t, (const int[]){lengths[(round + y + z) % LENGTHS], lengths[y], lengths[z]});
    print_tally(t);
}

CASE(test_mixed)
{
    test_run *const t = start("mixed");
    for (size_t round = 0; round < MIXED_A_ROUND * arguments_rounds(&args, PAIRS_A_ROUND); round++)
        try_mixed(t);
    print_tally(t);
}

CASE(test_specks)
{
    test_run *const t = start("specks");
    for (size_t round = 0; round < SPECKS_A_ROUND * arguments_rounds(&args, PAIRS_A_ROUND); round++)
        try_speck(t);
    print_tally(t);
}

PROGRAM(RUN(test_lengths), RUN(test_mixed), RUN(test_specks))
