/*
 * test_cells.c - every kind of triangle in every kind of grid, cell by cell against the oracle: EXACT is right from every kernel,
 * one triangle a call and many, in windows as in the whole, by every set of axes; CONSERVATIVE never misses, nor does FAST for
 * doubles; for floats both err within their band alone.
 */
#include "cell_oracle.h"
#include "cells.h"

#include <math.h>

#include "common/harness.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum {
    ROUNDS = 12,                     /* of every kind of triangle in every kind of grid */
    PAIRS_A_ROUND = 100000 / ROUNDS, /* of the arguments: --long asks a hundred times as much, --short a twelfth */
    CELLS_MAX = 20000,               /* of a grid */
    CELLS_OF_DOUBLES = 2000,         /* a grid of doubles, and one of which all cells are asked about */
    CELLS_FOR_ALL = 300,
    ASKED_MAX = 16000, /* cells that the oracle is asked about in a run: at this number no more triangles are drawn */
    ALONE_MAX = 24     /* triangles of a run that are voxelized one by one */
};

static random_source r;
static cells_case drawn;
static uint64_t expected[CELLS_MAX], occupied[CELLS_MAX]; /* rows of one cell take a word each */

static struct {
    size_t runs, asked, set;
    tally conservative, fast;
} sum;

static void choose(tribox_accuracy accuracy, unsigned axes, int kernel)
{
    drawn.options = (tribox_options){
        .accuracy = accuracy, .axes = axes, .axis_order = order_digits(random_int(&r, ORDERS)), .kernel = names[kernel]};
}

static void check_together(unsigned axes)
{
    for (int kernel = 0; kernel < kernels; kernel++) {
        choose(TRIBOX_EXACT, axes, kernel);
        cells_ask(&drawn, 0, drawn.count, occupied);
        cells_check(&drawn, 0, drawn.count, expected, occupied);
    }
}

static void check_others(unsigned axes, bool is_within_fast)
{
    for (int accuracy = TRIBOX_CONSERVATIVE; accuracy <= TRIBOX_FAST; accuracy++) {
        choose((tribox_accuracy)accuracy, axes, random_int(&r, kernels));
        cells_ask(&drawn, 0, drawn.count, occupied);
        cells_check(&drawn, 0, drawn.count, expected, occupied);
        if (!drawn.is_double && (accuracy != TRIBOX_FAST || is_within_fast))
            cells_check_band(&drawn, expected, occupied, accuracy == TRIBOX_FAST ? &sum.fast : &sum.conservative);
    }
}

/* Among many triangles another may hide what one of them gets wrong. In the whole grid, or a window. */
static void check_alone(unsigned axes)
{
    for (size_t k = 0; k < drawn.count; k += drawn.count / ALONE_MAX + 1) {
        if (random_int(&r, 2))
            cells_draw_window(&drawn, &r);
        sum.asked += cells_expect(&drawn, k, 1, axes, expected);
        choose(TRIBOX_EXACT, axes, random_int(&r, kernels));
        cells_ask(&drawn, k, 1, occupied);
        cells_check(&drawn, k, 1, expected, occupied);
        cells_open(&drawn);
    }
}

static void check(unsigned axes, bool is_within_fast)
{
    sum.asked += cells_expect(&drawn, 0, drawn.count, axes, expected);
    sum.runs++;
    sum.set += cells_count(expected, cells_words(&drawn));
    check_together(axes);
    check_others(axes, is_within_fast);
    check_alone(axes);
}

static bool start(const char *scene)
{
    r = random_named(args.seed, scene);
    memset(&sum, 0, sizeof sum);
    return !args.scenes || !strcmp(args.scenes, scene);
}

static void print_sum(const char *scene)
{
    printf("%-18s %6zu runs, %zu asked, %zu set, CONSERVATIVE %zu more, FAST %zu more and %zu missing of %zu\n", scene, sum.runs,
           sum.asked, sum.set, sum.conservative.extra, sum.fast.extra, sum.fast.missed, sum.fast.asked);
    fflush(stdout);
    assert_true(sum.set > 0);
}

static size_t few_or_many(int few, int least, int most)
{
    return (size_t)(random_int(&r, 2) ? random_int_between(&r, 1, few) : random_int_between(&r, least, most));
}

CASE(test_kinds)
{
    for (size_t s = 0; s <= triangle_kind_count(); s++) {
        const triangle_kind *const kind = s < triangle_kind_count() ? triangle_kind_at(s) : NULL;
        const char *const scene = kind ? kind->name : "mesh";
        if (!start(scene))
            continue;
        for (size_t k = 0; k < grid_kind_floats() * arguments_rounds(&args, PAIRS_A_ROUND); k++) {
            const grid_kind *const grid = grid_kind_at(k % grid_kind_floats());
            draw_grid_of_kind(&r, grid, CELLS_MAX, &drawn);
            if (kind)
                put_triangles(&r, kind, few_or_many(5, 60, 200), ASKED_MAX, &drawn);
            else
                put_mesh(&r, &drawn);
            drawn.scene = scene;
            check(TRIBOX_AXES_ALL, (!kind || kind->is_within_fast) && grid->is_within_fast);
        }
        print_sum(scene);
    }
}

CASE(test_doubles)
{
    /* Those that the box normals are part of cost the oracle less. */
    static const unsigned axis_sets[] = {7, 7, 7, 7, 7, 3, 3, 5, 1, 2, 4, 6};
    for (size_t g = grid_kind_floats(); g < grid_kind_count(); g++) {
        if (!start(grid_kind_at(g)->name))
            continue;
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++) {
            const unsigned axes = axis_sets[random_int(&r, (int)(sizeof axis_sets / sizeof axis_sets[0]))];
            draw_grid_of_kind(&r, grid_kind_at(g), axes & TRIBOX_AXES_BOX ? CELLS_OF_DOUBLES : CELLS_FOR_ALL, &drawn);
            put_triangles(&r, NULL, few_or_many(6, 20, 60), ASKED_MAX, &drawn);
            check(axes, false);
        }
        print_sum(drawn.scene);
    }
}

/* The oracle is asked about every cell, wherever in the grid it lies. */
CASE(test_axis_sets)
{
    enum { FEW = 400, TIMES = 8 };
    const size_t often = TIMES * grid_kind_floats(), of_doubles = grid_kind_count() - grid_kind_floats();
    size_t set[AXIS_SETS + 1] = {0};
    for (size_t s = 0; s < triangle_kind_count(); s++) {
        start(triangle_kind_at(s)->name);
        for (size_t k = 0; k < (often + of_doubles) * arguments_rounds(&args, 100000); k++) {
            const size_t n = k % (often + of_doubles);
            draw_grid_of_kind(&r, grid_kind_at(n < often ? n % grid_kind_floats() : grid_kind_floats() + n - often), FEW, &drawn);
            put_triangles(&r, triangle_kind_at(s), random_int(&r, 2) ? 1 : 3, SIZE_MAX, &drawn);
            for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
                cells_expect(&drawn, 0, drawn.count, axes, expected);
                set[axes] += cells_count(expected, cells_words(&drawn));
                for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_CONSERVATIVE; accuracy++) {
                    choose((tribox_accuracy)accuracy, axes, random_int(&r, kernels));
                    cells_ask(&drawn, 0, drawn.count, occupied);
                    cells_check(&drawn, 0, drawn.count, expected, occupied);
                }
            }
        }
    }
    for (unsigned axes = 1; axes < TRIBOX_AXES_ALL; axes++)
        assert_true(set[axes] > set[TRIBOX_AXES_ALL]);
}

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

PROGRAM(RUN(test_judge), RUN(test_kinds), RUN(test_doubles), RUN(test_axis_sets), RUN(test_planes_of_slivers))
