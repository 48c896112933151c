/*
 * test_cells_f64.c - triangles of doubles in kinds of grids in double, cell by cell against the oracle: EXACT is right from every
 * kernel, one triangle a call and many, in windows as in the whole, by every set of axes; CONSERVATIVE and FAST never miss.
 */
#include <stdio.h>
#include <string.h>

#include "common/arguments.h"
#include "scenes_f64.h"

enum { PAIRS_A_ROUND = 7000, CELLS_FOR_ALL = 300, LONG = 1000 };

typedef struct trial {
    random_source r;
    window_f64 w;
    uint64_t expected[WINDOW_CELLS + 1], occupied[WINDOW_CELLS + 1];
    const char *kernels[KERNELS_MAX];
    int kernel_count;
} trial;

static trial test;

/* The whole grid by all kernels, and CONSERVATIVE and FAST by one. */
static size_t check_whole(trial *t, unsigned axes)
{
    window_f64_open(&t->w);
    const size_t asked = window_f64_expect(&t->w, 0, t->w.count, axes, t->expected);
    for (int kernel = 0; kernel < t->kernel_count; kernel++) {
        t->w.options = (tribox_options){.axes = axes, .kernel = t->kernels[kernel]};
        window_f64_ask(&t->w, 0, t->w.count, t->occupied);
        window_f64_check(&t->w, 0, t->w.count, t->expected, t->occupied, true);
    }
    for (int accuracy = TRIBOX_CONSERVATIVE; accuracy <= TRIBOX_FAST; accuracy++) {
        t->w.options.accuracy = (tribox_accuracy)accuracy;
        t->w.options.kernel = t->kernels[random_int(&t->r, t->kernel_count)];
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
    t->w.options = (tribox_options){.axes = axes, .kernel = t->kernels[random_int(&t->r, t->kernel_count)]};
    const size_t asked = window_f64_expect(&t->w, k, 1, axes, t->expected);
    window_f64_ask(&t->w, k, 1, t->occupied);
    window_f64_check(&t->w, k, 1, t->expected, t->occupied, true);
    return asked;
}

/* Until the oracle has enough to do. */
static void draw_triangles(trial *t)
{
    const bool is_few = t->w.grid.size[0] > LONG || random_int(&t->r, 2);
    const int count = is_few ? random_int_between(&t->r, 1, 6) : random_int_between(&t->r, 20, 60);
    for (t->w.count = 0; t->w.count < (size_t)count; t->w.count++)
        draw_triangle_f64(&t->r, &t->w.grid, t->w.triangle[t->w.count]);
}

static void test_scenes(void **state)
{
    const arguments *const args = *state;
    trial *const t = &test;
    t->kernel_count = kernels_here(t->kernels);
    for (size_t s = 0; s < scene_f64_count(); s++) {
        const scene_f64 *const scene = scene_f64_at(s);
        size_t asked = 0;
        if (args->scenes && strcmp(args->scenes, scene->name))
            continue;
        t->r = random_named(args->seed, scene->name);
        t->w.scene = scene->name;
        t->w.seed = args->seed;
        for (size_t round = 0; round < arguments_rounds(args, PAIRS_A_ROUND); round++) {
            const unsigned axes = round % 3 ? TRIBOX_AXES_ALL : (unsigned)random_int_between(&t->r, 1, 7);
            draw_grid_f64(&t->r, scene, axes & TRIBOX_AXES_BOX ? 2000 : CELLS_FOR_ALL, &t->w.grid);
            draw_triangles(t);
            asked += check_whole(t, axes);
            for (int n = 0; n < 4; n++)
                asked += check_alone(t, axes);
        }
        printf("%-12s %zu pairs\n", scene->name, asked);
        fflush(stdout);
    }
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_scenes, &args)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
