/*
 * test_axis_sets.c - every set of axes: EXACT sets the cells that no chosen axis separates from the triangle, wherever in the grid
 * they lie. The oracle is asked about every cell.
 */
#include "occupancy.h"

#include "common/harness.h"
#include "grid_kinds.h"
#include "cell_oracle.h"
#include "triangle_kinds.h"

enum { PAIRS_A_ROUND = 100000, CELLS_MAX = 400, TRIANGLES = 3 };

static grid_planes at;
static triangle_list triangles;
static uint64_t expected[CELLS_MAX], occupied[CELLS_MAX];

static void check_axes(random_source *r, request *q, unsigned axes)
{
    memset(expected, 0, sizeof expected);
    for (size_t t = 0; t < triangles.count; t++) {
        float u[3][3];
        triangle_list_get(&triangles, t, u);
        occupancy_add(&at, (const_vertices)u, axes, expected);
    }
    for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_CONSERVATIVE; accuracy++) {
        q->options = (tribox_options){.accuracy = (tribox_accuracy)accuracy,
                                      .axes = axes,
                                      .axis_order = order_digits(random_int(r, ORDERS)),
                                      .kernel = names[random_int(r, kernels)]};
        request_ask(q, 0, triangles.count, occupied);
        for (size_t w = 0; accuracy != TRIBOX_EXACT && w < at.words; w++)
            occupied[w] &= expected[w]; /* what it sets besides is test_cells.c's business */
        request_check_exact(q, 0, triangles.count, expected, occupied);
    }
}

CASE(test_axis_sets)
{
    size_t set[AXIS_SETS + 1] = {0};
    for (size_t s = 0; s < triangle_kind_count(); s++) {
        random_source r = random_named(args.seed, triangle_kind_at(s)->name);
        request q = {.scene = triangle_kind_at(s)->name, .seed = args.seed, .at = &at, .triangles = &triangles};
        for (size_t k = 0; k < 8 * grid_kind_count() * arguments_rounds(&args, PAIRS_A_ROUND); k++) {
            draw_grid_of_kind(&r, grid_kind_at(k % grid_kind_count()), CELLS_MAX, &at);
            for (triangles.count = 0; triangles.count < (random_int(&r, 2) ? 1 : TRIANGLES);) {
                float u[3][3];
                draw_triangle(&r, triangle_kind_at(s), &at, u);
                triangle_list_put(&triangles, (const_vertices)u);
            }
            for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
                check_axes(&r, &q, axes);
                set[axes] += occupancy_count(expected, at.words);
            }
        }
    }
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++)
        printf("axes %u: %zu cells set\n", axes, set[axes]);
    for (unsigned axes = 1; axes < TRIBOX_AXES_ALL; axes++)
        assert_true(set[axes] > set[TRIBOX_AXES_ALL]);
}

/* The cell oracle is trusted as far as the two other oracles agree with it. */
CASE(test_judge)
{
    size_t overlaps = 0, asked = 0;
    random_source r = random_named(args.seed, "judge");
    for (size_t k = 0; k < args.pairs / 10; k++) {
        if (k % 20 == 0)
            draw_grid_of_kind(&r, grid_kind_at(k / 20 % grid_kind_count()), CELLS_MAX, &at);
        pair_f32 pair;
        draw_triangle(&r, triangle_kind_at(k % triangle_kind_count()), &at, pair.u);
        pair.box = grid_planes_cell(&at, random_int(&r, (int)at.grid.size[0]), random_int(&r, (int)at.grid.size[1]),
                                    random_int(&r, (int)at.grid.size[2]));
        const cell_oracle t = cell_oracle_make(triangle_of(&pair));
        const oracle_axes truth = oracle_separating_gmp(&pair);
        for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++)
            assert_int_equal(cell_oracle_overlaps(&t, &pair.box, axes), oracle_overlaps(truth, axes));
        assert_int_equal(cell_oracle_overlaps(&t, &pair.box, TRIBOX_AXES_ALL), oracle_clip(&pair));
        overlaps += oracle_overlaps(truth, TRIBOX_AXES_ALL);
        asked++;
    }
    printf("cell oracle asked about %zu pairs, %zu overlap\n", asked, overlaps);
    assert_in_range(overlaps, asked / 100, asked - asked / 100);
}

PROGRAM(RUN(test_judge), RUN(test_axis_sets))
