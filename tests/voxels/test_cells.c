/*
 * test_cells.c - every kind of triangle in every kind of grid, cell by cell against the oracle: EXACT is right from every kernel,
 * one triangle a call and many; CONSERVATIVE never misses; CONSERVATIVE and FAST err within their band alone.
 */
#include "occupancy.h"

#include "common/harness.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum {
    ROUNDS = 12,                     /* of every kind of triangle in every kind of grid */
    PAIRS_A_ROUND = 100000 / ROUNDS, /* of the arguments: --long asks a hundred times as much, --short a twelfth */
    CELLS_MAX = 20000,               /* of a grid */
    ASKED_MAX = 16000,               /* cells that the oracle is asked about in a run: at this number no more triangles are drawn */
    ALONE_MAX = 24                   /* triangles of a run that are voxelized one by one */
};

typedef struct test_run {
    random_source r;
    request q;
    grid_planes at;
    triangle_list triangles;
    uint64_t expected[CELLS_MAX], occupied[CELLS_MAX], one[CELLS_MAX]; /* rows of one cell take a word each */
    size_t runs, asked, set;
    tally conservative, fast;
} test_run;

static test_run run;

static void choose(test_run *t, tribox_accuracy accuracy, int kernel)
{
    t->q.options =
        (tribox_options){.accuracy = accuracy, .axis_order = order_digits(random_int(&t->r, ORDERS)), .kernel = names[kernel]};
}

static void check_together(test_run *t)
{
    for (int kernel = 0; kernel < kernels; kernel++) {
        choose(t, TRIBOX_EXACT, kernel);
        request_ask(&t->q, 0, t->triangles.count, t->occupied);
        request_check_exact(&t->q, 0, t->triangles.count, t->expected, t->occupied);
    }
}

/* Among many triangles another may hide what one of them gets wrong. */
static void check_alone(test_run *t)
{
    const size_t step = t->triangles.count / ALONE_MAX + 1;
    for (size_t k = 0; k < t->triangles.count; k += step) {
        float u[3][3];
        triangle_list_get(&t->triangles, k, u);
        memset(t->one, 0, t->at.words * sizeof *t->one);
        t->asked += occupancy_add(&t->at, (const_vertices)u, TRIBOX_AXES_ALL, t->one);
        choose(t, TRIBOX_EXACT, random_int(&t->r, kernels));
        request_ask(&t->q, k, 1, t->occupied);
        request_check_exact(&t->q, k, 1, t->one, t->occupied);
    }
}

static void check_band(test_run *t, bool is_within_fast)
{
    for (int accuracy = TRIBOX_CONSERVATIVE; accuracy <= TRIBOX_FAST; accuracy++) {
        if (accuracy == TRIBOX_FAST && !is_within_fast)
            continue;
        choose(t, (tribox_accuracy)accuracy, random_int(&t->r, kernels));
        request_ask(&t->q, 0, t->triangles.count, t->occupied);
        request_check_band(&t->q, t->expected, t->occupied, accuracy == TRIBOX_FAST ? &t->fast : &t->conservative);
    }
}

static void try_triangles(test_run *t, bool is_within_fast)
{
    memset(t->expected, 0, t->at.words * sizeof *t->expected);
    for (size_t k = 0; k < t->triangles.count; k++) {
        float u[3][3];
        triangle_list_get(&t->triangles, k, u);
        t->asked += occupancy_add(&t->at, (const_vertices)u, TRIBOX_AXES_ALL, t->expected);
    }
    t->runs++;
    t->set += occupancy_count(t->expected, t->at.words);
    check_together(t);
    check_alone(t);
    check_band(t, is_within_fast);
}

static void draw_triangles(test_run *t, const triangle_kind *s)
{
    const int most = random_int(&t->r, 2) ? random_int_between(&t->r, 1, 5) : random_int_between(&t->r, 60, 200);
    size_t cost = 0;
    for (t->triangles.count = 0; t->triangles.count < (size_t)most && cost < ASKED_MAX;) {
        float u[3][3];
        draw_triangle(&t->r, s, &t->at, u);
        cost += occupancy_cost(&t->at, (const_vertices)u, TRIBOX_AXES_ALL);
        triangle_list_put(&t->triangles, (const_vertices)u);
    }
}

static void start(test_run *t, const char *name)
{
    t->r = random_named(args.seed, name);
    t->q = (request){.scene = name, .seed = args.seed, .at = &t->at, .triangles = &t->triangles};
    t->runs = t->asked = t->set = 0;
    t->conservative = t->fast = (tally){0};
}

static void print_tally(const char *name, const test_run *t)
{
    printf("%-16s %7zu %10zu %9zu %12zu %9zu %9zu %9zu\n", name, t->runs, t->asked, t->set, t->conservative.extra, t->fast.asked,
           t->fast.missed, t->fast.extra);
    fflush(stdout);
    assert_true(t->set > 0);
}

CASE(test_kinds)
{
    test_run *const t = &run;
    printf("%-16s %7s %10s %9s %12s %9s %9s %9s\n", "", "runs", "asked", "set", "cons. extra", "fast asked", "missed", "extra");
    for (size_t s = 0; s <= triangle_kind_count(); s++) {
        const triangle_kind *const kind = s < triangle_kind_count() ? triangle_kind_at(s) : NULL;
        const char *const scene = kind ? kind->name : "mesh";
        if (args.scenes && strcmp(args.scenes, scene))
            continue;
        start(t, scene);
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++)
            for (size_t g = 0; g < grid_kind_count(); g++) {
                draw_grid_of_kind(&t->r, grid_kind_at(g), CELLS_MAX, &t->at);
                t->triangles.count = 0;
                if (kind)
                    draw_triangles(t, kind);
                else
                    draw_mesh(&t->r, &t->at, &t->triangles);
                try_triangles(t, (!kind || kind->is_within_fast) && grid_kind_at(g)->is_within_fast);
            }
        print_tally(scene, t);
    }
}

PROGRAM(RUN(test_kinds))
