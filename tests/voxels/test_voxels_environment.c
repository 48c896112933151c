/*
 * test_voxels_environment.c - the caller's rounding mode, flush-to-zero and traps change no bit of a voxelization and no cell of a
 * grid, and come back as they were, on refusals too.
 */
#include "occupancy.h"

#include <string.h>

#include "common/arguments.h"
#include "grid_kinds.h"
#include "common/guard.h"
#include "common/float_environment.h"
#include "grid_scenes_f64.h"
#include "triangle_kinds.h"

enum { CELLS_MAX = 3000, TRIANGLES = 30, ROUNDS = 20, PAIRS_A_ROUND = 100000 / ROUNDS };

static grid_planes at;
static triangle_list triangles;
static uint64_t expected[CELLS_MAX], occupied[CELLS_MAX];

static void draw_pairs(random_source *r, size_t round)
{
    draw_grid_of_kind(r, grid_kind_at(round % grid_kind_count()), CELLS_MAX, &at);
    for (triangles.count = 0; triangles.count < TRIANGLES;) {
        float u[3][3];
        draw_triangle(r, triangle_kind_at((size_t)random_int(r, (int)triangle_kind_count())), &at, u);
        triangle_list_put(&triangles, (const_vertices)u);
    }
}

static void check_setting(unsigned set, const tribox_options *options, const tribox_report *expected_report)
{
    const unsigned normal = environment_get();
    const tribox_soup soup = triangle_list_soup(&triangles);
    tribox_report report;
    snprintf(doing, sizeof doing, "tribox_voxelize under setting %#x, accuracy %d, kernel %s", set, (int)options->accuracy,
             options->kernel);
    memset(occupied, 0, at.words * sizeof *occupied);
    environment_set(set);
    const tribox_status status = tribox_voxelize(&soup, &at.grid, NULL, options, occupied, &report);
    const unsigned left = environment_get();
    environment_set(normal);
    assert_int_equal(status, TRIBOX_OK);
    if (left != set)
        fail_msg("%s: left as %#x", doing, left);
    if (memcmp(occupied, expected, at.words * sizeof *occupied))
        fail_msg("%s: other bits", doing);
    assert_int_equal(report.overlapping, expected_report->overlapping);
}

static void test_voxelize(void **state)
{
    const arguments *const args = *state;
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    catch_faults();
    random_source r = random_named(args->seed, "environment");
    for (size_t round = 0; round < grid_kind_count() * arguments_rounds(args, PAIRS_A_ROUND); round++) {
        draw_pairs(&r, round);
        const tribox_options options = {.accuracy = (tribox_accuracy)(round % 2 ? 0 : random_int(&r, 3)),
                                        .axes = (unsigned)random_int(&r, 8) % AXIS_SETS,
                                        .kernel = kernels[random_int(&r, kernel_count)]};
        const tribox_soup soup = triangle_list_soup(&triangles);
        tribox_report report;
        memset(expected, 0, at.words * sizeof *expected);
        assert_int_equal(tribox_voxelize(&soup, &at.grid, NULL, &options, expected, &report), TRIBOX_OK);
        for (unsigned k = 0; k < SETTINGS; k++)
            check_setting(setting(k), &options, &report);
    }
}

/* A mesh of doubles. */
static void test_doubles(void **state)
{
    const arguments *const args = *state;
    static window_f64 w;
    static uint64_t usual[WINDOW_CELLS + 1], found[WINDOW_CELLS + 1];
    random_source r = random_named(args->seed, "doubles");
    const unsigned normal = environment_get();
    for (size_t round = 0; round < 4 * scene_f64_count(); round++) {
        const scene_f64 *const scene = scene_f64_at(round % scene_f64_count());
        w = (window_f64){.scene = scene->name, .seed = args->seed, .count = 20};
        draw_grid_f64(&r, scene, 2000, &w.grid);
        for (size_t t = 0; t < w.count; t++)
            draw_triangle_f64(&r, &w.grid, w.triangle[t]);
        window_f64_open(&w);
        window_f64_ask(&w, 0, w.count, usual);
        const tribox_mesh mesh = {.positions = w.triangle, .vertices = 3 * w.count, .count = w.count, .position_bytes = 8};
        for (unsigned k = 0; k < SETTINGS; k++) {
            memset(found, 0, sizeof found);
            environment_set(setting(k));
            const tribox_status status = tribox_mesh_voxelize(&mesh, &w.grid, NULL, NULL, found, NULL);
            const unsigned left = environment_get();
            environment_set(normal);
            assert_int_equal(status, TRIBOX_OK);
            assert_int_equal(left, setting(k));
            assert_memory_equal(found, usual, window_f64_words(&w) * sizeof *found);
        }
    }
}

/* Planes that must not be flushed or rounded the other way. */
static void test_cells(void **state)
{
    const arguments *const args = *state;
    catch_faults();
    snprintf(doing, sizeof doing, "tribox_grid_cell");
    random_source r = random_named(args->seed, "cells");
    const unsigned normal = environment_get();
    for (size_t round = 0; round < 400; round++) {
        draw_grid_of_kind(&r, grid_kind_at(round % grid_kind_count()), CELLS_MAX, &at);
        for (unsigned k = 0; k < SETTINGS; k++) {
            int cell[3];
            for (int a = 0; a < 3; a++)
                cell[a] = random_int(&r, (int)at.grid.size[a]);
            const tribox_box right = grid_planes_cell(&at, cell[0], cell[1], cell[2]);
            environment_set(setting(k));
            const tribox_box box = tribox_grid_cell(&at.grid, (uint32_t)cell[0], (uint32_t)cell[1], (uint32_t)cell[2]);
            const unsigned left = environment_get();
            environment_set(normal);
            assert_int_equal(left, setting(k));
            assert_memory_equal(&box, &right, sizeof box);
        }
    }
}

/* A subnormal cell is greater than zero whatever the caller flushes; NaN traps nothing. */
static void test_refusals(void **state)
{
    (void)state;
    catch_faults();
    static const uint64_t length[] = {
        1, UINT64_C(1) << 63 | 1, UINT64_C(0x7ff) << 52 | 1, UINT64_C(0x7ff8) << 48, UINT64_C(0x7ff) << 52, 0};
    const unsigned normal = environment_get();
    for (size_t b = 0; b < sizeof length / sizeof length[0]; b++)
        for (unsigned k = 0; k < SETTINGS; k++) {
            tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
            uint64_t words[4] = {0};
            const tribox_soup none = {.count = 0};
            memcpy(&grid.cell[b % 3], &length[b], sizeof length[b]);
            snprintf(doing, sizeof doing, "a grid of cell %#llx under setting %#x", (unsigned long long)length[b], setting(k));
            environment_set(setting(k));
            const tribox_status status = tribox_voxelize(&none, &grid, NULL, NULL, words, NULL);
            const unsigned left = environment_get();
            environment_set(normal);
            assert_int_equal(left, setting(k));
            assert_int_equal(status, b ? TRIBOX_BAD_GRID : TRIBOX_OK);
        }
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_voxelize, &args),
        cmocka_unit_test_prestate(test_doubles, &args),
        cmocka_unit_test_prestate(test_cells, &args),
        cmocka_unit_test_prestate(test_refusals, &args),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
