/*
 * test_cells_f64.c - triangles of doubles in kinds of grids in double, cell by cell against the oracle: EXACT is right from every
 * kernel, one triangle a call and many, in windows as in the whole, by every set of axes; CONSERVATIVE and FAST never miss.
 */
#include <math.h>

#include "common/harness.h"
#include "grid_scenes_f64.h"

enum { PAIRS_A_ROUND = 10000, CELLS_FOR_ALL = 300 };

typedef struct trial {
    random_source r;
    window_f64 w;
    uint64_t expected[WINDOW_CELLS + 1], occupied[WINDOW_CELLS + 1];
} trial;

static trial test;

/* Those that the box normals are part of cost the oracle less. */
static const unsigned axis_sets[] = {7, 7, 7, 7, 7, 3, 3, 5, 1, 2, 4, 6};

/* The whole grid by all kernels, and CONSERVATIVE and FAST by one. */
static size_t check_whole(trial *t, unsigned axes)
{
    window_f64_open(&t->w);
    const size_t asked = window_f64_expect(&t->w, 0, t->w.count, axes, t->expected);
    for (int kernel = 0; kernel < kernels; kernel++) {
        t->w.options = (tribox_options){.axes = axes, .kernel = names[kernel]};
        window_f64_ask(&t->w, 0, t->w.count, t->occupied);
        window_f64_check(&t->w, 0, t->w.count, t->expected, t->occupied, true);
    }
    for (int accuracy = TRIBOX_CONSERVATIVE; accuracy <= TRIBOX_FAST; accuracy++) {
        t->w.options.accuracy = (tribox_accuracy)accuracy;
        t->w.options.kernel = names[random_int(&t->r, kernels)];
        window_f64_ask(&t->w, 0, t->w.count, t->occupied);
        window_f64_check(&t->w, 0, t->w.count, t->expected, t->occupied, false);
    }
    return asked;
}

/* One triangle, in a window of its own. */
static size_t check_alone(trial *t, unsigned axes)
{
    const size_t k = (size_t)random_int(&t->r, (int)t->w.count);
    window_f64_draw(&t->w, &t->r);
    t->w.options = (tribox_options){.axes = axes, .kernel = names[random_int(&t->r, kernels)]};
    const size_t asked = window_f64_expect(&t->w, k, 1, axes, t->expected);
    window_f64_ask(&t->w, k, 1, t->occupied);
    window_f64_check(&t->w, k, 1, t->expected, t->occupied, true);
    return asked;
}

CASE(test_scenes)
{
    trial *const t = &test;
    for (size_t s = 0; s < scene_f64_count(); s++) {
        const scene_f64 *const scene = scene_f64_at(s);
        size_t asked = 0;
        if (args.scenes && strcmp(args.scenes, scene->name))
            continue;
        t->r = random_named(args.seed, scene->name);
        for (size_t round = 0; round < arguments_rounds(&args, PAIRS_A_ROUND); round++) {
            const unsigned axes = axis_sets[random_int(&t->r, (int)(sizeof axis_sets / sizeof axis_sets[0]))];
            window_f64_draw_scene(&t->w, &t->r, scene, axes & TRIBOX_AXES_BOX ? 2000 : CELLS_FOR_ALL);
            asked += check_whole(t, axes);
            for (int n = 0; n < 4; n++)
                asked += check_alone(t, axes);
        }
        printf("%-12s %zu pairs\n", scene->name, asked);
        fflush(stdout);
    }
}

/*
 * Slivers far along x, where float moves a vertex by a notable part of their height, which turns their planes: by box normals and
 * plane nothing but the doubles decides.
 */
CASE(test_planes_of_slivers)
{
    trial *const t = &test;
    t->r = random_named(args.seed, "slivers");
    t->w = (window_f64){.scene = "slivers",
                        .seed = args.seed,
                        .grid = {{0.3, -7, 100}, {0.1, 0.1, 0.1}, {60000, 2, 2}},
                        .at = {.size = {60000, 2, 2}}};
    for (size_t round = 0; round < 50 * arguments_rounds(&args, 100000); round++) {
        for (t->w.count = 0; t->w.count < 10; t->w.count++) {
            double(*const u)[3] = t->w.triangle[t->w.count];
            const double at = random_double(&t->r, 59000, 59990), height = ldexp(1, random_int_between(&t->r, -13, -5));
            for (int a = 0; a < 3; a++) {
                const double from = a ? random_double(&t->r, -1, 3) : at, to = a ? random_double(&t->r, -1, 3) : at + 7;
                u[0][a] = window_f64_plane(&t->w.grid, a, from);
                u[1][a] = window_f64_plane(&t->w.grid, a, to);
                u[2][a] = window_f64_plane(&t->w.grid, a, (from + to) / 2 + height * random_double(&t->r, -1, 1));
            }
        }
        window_f64_expect(&t->w, 0, t->w.count, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE, t->expected);
        t->w.options = (tribox_options){.axes = TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE, .kernel = names[random_int(&t->r, kernels)]};
        window_f64_ask(&t->w, 0, t->w.count, t->occupied);
        window_f64_check(&t->w, 0, t->w.count, t->expected, t->occupied, true);
    }
}

PROGRAM(RUN(test_scenes), RUN(test_planes_of_slivers))
