/*
 * test_classes.c - triangles whose bounding boxes are 1 to 33 cells long, each length on each axis with each on the others: where
 * one way of the library ends and the next begins, at the ends of words, across the sides of the grid and of its layers.
 *
 * A soup holds one of them or a few over and over, or many of all lengths. EXACT is right from every kernel and counts each cell
 * once; CONSERVATIVE never misses; CONSERVATIVE and FAST err within their band alone; and at every accuracy layers have the bits of
 * the whole, which depend neither on the order of the triangles nor on how often they come.
 */
#include "occupancy.h"

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
    const char *scene;
    grid_planes at;
    triangle_list own, all; /* the triangles, and these over and over */
    uint64_t expected[WORDS_MAX], occupied[WORDS_MAX], other[WORDS_MAX];
    size_t soups, asked, set;
    tally conservative, fast;
} test_run;

/* Cells from `first` on; those below 0 or past the end lie outside the grid. */
typedef struct cell_span {
    int first, length;
} cell_span;

static request request_of(const test_run *t, const triangle_list *triangles, tribox_accuracy accuracy, int kernel)
{
    return (request){.scene = t->scene,
                     .seed = args.seed,
                     .at = &t->at,
                     .triangles = triangles,
                     .options = {.accuracy = accuracy, .kernel = names[kernel]}};
}

static void fail_soup(const test_run *t, const request *q, const char *what)
{
    grid_planes_print(stderr, &t->at.grid);
    for (size_t k = 0; k < t->own.count; k++)
        for (int j = 0; j < 3; j++)
            fprintf(stderr, "  triangle %zu: %a %a %a\n", k, (double)t->own.coordinate[j][0][k], (double)t->own.coordinate[j][1][k],
                    (double)t->own.coordinate[j][2][k]);
    fail_msg("scene %s, seed %llu, %zu triangles, accuracy %d, kernel %s: %s", t->scene, (unsigned long long)args.seed,
             q->triangles->count, (int)q->options.accuracy, q->options.kernel, what);
}

/* The layers in parts, against the bits of the whole. */
static void check_layers(test_run *t, const request *q, const uint64_t *whole)
{
    const tribox_soup soup = triangle_list_soup(q->triangles);
    const uint32_t size = t->at.grid.size[2];
    const size_t layer_words = t->at.row_words * t->at.grid.size[1];
    size_t set = 0;
    memset(t->other, 0, t->at.words * sizeof *t->other);
    for (uint32_t first = 0, layers; first < size; first += layers) {
        tribox_report report;
        layers = 1 + (uint32_t)random_int(&t->r, (int)(size - first));
        assert_int_equal(tribox_voxelize(&soup, &t->at.grid,
                                         &(tribox_window){{0, 0, first}, {t->at.grid.size[0], t->at.grid.size[1], layers}},
                                         &q->options, t->other + first * layer_words, &report),
                         TRIBOX_OK);
        set += report.overlapping;
    }
    if (memcmp(t->other, whole, t->at.words * sizeof *whole))
        fail_soup(t, q, "layers have other bits than the whole");
    if (set != occupancy_count(whole, t->at.words))
        fail_soup(t, q, "layers count other cells than the whole");
}

static void check_exact(test_run *t, int kernel)
{
    const request q = request_of(t, &t->all, TRIBOX_EXACT, kernel);
    const tribox_soup soup = triangle_list_soup(&t->all);
    tribox_report report;
    request_ask(&q, 0, t->all.count, t->occupied);
    request_check_exact(&q, 0, t->all.count, t->expected, t->occupied);
    check_layers(t, &q, t->occupied);
    assert_int_equal(tribox_voxelize(&soup, &t->at.grid, NULL, &q.options, t->occupied, &report), TRIBOX_OK);
    if (report.overlapping || memcmp(t->occupied, t->expected, t->at.words * sizeof *t->expected))
        fail_soup(t, &q, "asked again it sets more cells");
}

static void check_rounded(test_run *t, tribox_accuracy accuracy, int kernel, bool has_band)
{
    const request q = request_of(t, &t->all, accuracy, kernel), alone = request_of(t, &t->own, accuracy, kernel);
    request_ask(&alone, 0, t->own.count, t->other);
    request_ask(&q, 0, t->all.count, t->occupied);
    if (memcmp(t->other, t->occupied, t->at.words * sizeof *t->other))
        fail_soup(t, &q, "copies of the triangles change cells");
    check_layers(t, &q, t->occupied);
    if (has_band)
        request_check_band(&alone, t->expected, t->occupied, accuracy == TRIBOX_FAST ? &t->fast : &t->conservative);
}

static void check_soup(test_run *t, bool is_within_fast)
{
    memset(t->expected, 0, t->at.words * sizeof *t->expected);
    for (size_t k = 0; k < t->own.count; k++) {
        float u[3][3];
        triangle_list_get(&t->own, k, u);
        t->asked += occupancy_add(&t->at, (const_vertices)u, TRIBOX_AXES_ALL, t->expected);
    }
    t->soups++;
    t->set += occupancy_count(t->expected, t->at.words);
    for (int kernel = 0; kernel < kernels; kernel++) {
        check_exact(t, kernel);
        check_rounded(t, TRIBOX_CONSERVATIVE, kernel, true);
        check_rounded(t, TRIBOX_FAST, kernel, is_within_fast);
    }
}

/* A number in a cell: on its planes, in its middle or anywhere, and often the float beside that. */
static float draw_in_cell(random_source *r, const tribox_grid *grid, int a, int cell)
{
    static const double part[] = {0, 0, 0.5, 1};
    const int n = random_int(r, 8);
    const float at = grid_planes_place(grid, a, cell + (n < 4 ? part[n] : random_double(r, 0, 1)));
    if (at == 0 && random_int(r, 2)) /* edges of next to no length: there floats are fine enough */
        return nearest_float(ldexp(random_double(r, -1, 1), -random_int_between(r, 30, 70)) * (double)grid->cell[a]);
    return random_int(r, 2) ? at : nudged(r, at, 1);
}

/* Of the vertices, in any order, one lies in the first cell of each span, one in the last and one between. */
static void draw_triangle(random_source *r, const tribox_grid *grid, const cell_span span[3], float u[3][3])
{
    const int thin = random_int(r, 6);
    for (int a = 0; a < 3; a++) {
        const int *const vertex = permutations[random_int(r, ORDERS)];
        const int last = span[a].first + span[a].length - 1;
        const int cell[3] = {span[a].first, last, random_int_between(r, span[a].first, last)};
        for (int j = 0; j < 3; j++)
            u[vertex[j]][a] = draw_in_cell(r, grid, a, cell[j]);
        if (span[a].length == 1 && random_int(r, 4) == 0)
            u[0][a] = u[1][a] = u[2][a];
    }
    const double along = thin == 0 ? random_double(r, 0, 1) : 1;
    for (int a = 0; thin < 2 && a < 3; a++) /* a cap or a needle */
        u[2][a] = nudged(r, nearest_float(u[0][a] + along * ((double)u[1][a] - u[0][a])), random_int(r, 2) ? 1 : 100);
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
    float u[3][3];
    draw_triangle(&t->r, &t->at.grid, span, u);
    triangle_list_put(&t->own, (const_vertices)u);
    return occupancy_cost(&t->at, (const_vertices)u, TRIBOX_AXES_ALL);
}

/* A copy with a number that is not finite: it overlaps nothing. */
static void put_spoiled(test_run *t)
{
    static const float numbers[] = {(float)NAN, INFINITY, -INFINITY};
    float u[3][3];
    triangle_list_get(&t->own, (size_t)random_int(&t->r, (int)t->own.count), u);
    u[random_int(&t->r, 3)][random_int(&t->r, 3)] = numbers[random_int(&t->r, 3)];
    triangle_list_put(&t->all, (const_vertices)u);
}

/* Begins with any of them, and may end with spoiled ones. */
static void repeat_triangles(test_run *t, size_t count)
{
    const size_t start = (size_t)random_int(&t->r, (int)t->own.count);
    for (t->all.count = 0; t->all.count < count;) {
        float u[3][3];
        triangle_list_get(&t->own, (start + t->all.count) % t->own.count, u);
        triangle_list_put(&t->all, (const_vertices)u);
    }
    for (int spoiled = random_int(&t->r, 4); spoiled > 0; spoiled--)
        put_spoiled(t);
}

/* A soup of triangles over these spans of cells. */
static void try_lengths(test_run *t, const int length[3])
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(&t->r, (int)grid_kind_count()));
    const size_t count = counts[random_int(&t->r, length[0] * length[1] * length[2] > LARGE ? SMALL_COUNTS : COUNTS)];
    cell_span span[3];
    uint32_t size[3];
    for (int a = 0; a < 3; a++)
        span[a] = place_span(&t->r, a, length[a], &size[a]);
    draw_grid_of_size(&t->r, kind, size, &t->at);
    assert_true(t->at.words <= WORDS_MAX);
    const size_t own = count < OWN_MAX ? count : (size_t)random_int_between(&t->r, 1, OWN_MAX);
    for (t->own.count = 0; t->own.count < own;)
        put_triangle(t, span);
    repeat_triangles(t, count);
    check_soup(t, kind->is_within_fast);
}

/* A soup of triangles of all lengths. */
static void try_mixed(test_run *t)
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(&t->r, (int)grid_kind_count()));
    const size_t own = counts[random_int(&t->r, COUNTS)];
    const uint32_t size[3] = {(uint32_t)random_int_between(&t->r, 30, 130), (uint32_t)random_int_between(&t->r, 8, 35),
                              (uint32_t)random_int_between(&t->r, 8, 35)};
    size_t cost = 0;
    draw_grid_of_size(&t->r, kind, size, &t->at);
    for (t->own.count = 0; t->own.count < own && cost < ASKED_MAX;) {
        const int reach = random_int(&t->r, 4) ? SHORT_LENGTHS : LENGTHS;
        cell_span span[3];
        for (int a = 0; a < 3; a++) {
            span[a].length = lengths[random_int(&t->r, reach)];
            span[a].first = random_int_between(&t->r, -2, (int)t->at.grid.size[a] + 1);
        }
        cost += put_triangle(t, span);
    }
    repeat_triangles(t, t->own.count + (size_t)random_int(&t->r, 40));
    check_soup(t, kind->is_within_fast);
}

/* A triangle far smaller than a cell, about a corner of cells at zero, where floats are fine enough for that. */
static void try_speck(test_run *t)
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(&t->r, (int)grid_kind_count()));
    const uint32_t size[3] = {5, 5, 5};
    draw_grid_of_size(&t->r, kind, size, &t->at);
    tribox_grid grid = t->at.grid;
    for (int a = 0; a < 3; a++)
        grid.origin[a] = -ldexp(grid.cell[a], random_int_between(&t->r, 0, 2));
    if (!grid_planes_make(&t->at, &grid))
        return;
    float u[3][3];
    for (int a = 0; a < 3; a++) {
        const int exponent = -random_int(&t->r, 130);
        for (int j = 0; j < 3; j++) {
            const double at = ldexp(random_double(&t->r, -1, 1), exponent) * grid.cell[a];
            const int n = random_int(&t->r, 8);
            u[j][a] = n > 2 ? nearest_float(at) : n > 1 ? copysignf(0x1p-149f, (float)at) : 0;
        }
    }
    t->own.count = 0;
    triangle_list_put(&t->own, (const_vertices)u);
    repeat_triangles(t, counts[random_int(&t->r, SMALL_COUNTS)]);
    check_soup(t, false);
}

static test_run *start(const char *scene)
{
    static test_run run;
    memset(&run, 0, sizeof run);
    run.scene = scene;
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
