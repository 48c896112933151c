/*
 * test_grid_f64.c - the planes of a grid in double are those of C's fma, a grid is served if and only if they rise, and whatever
 * cannot be served is refused with nothing written; the caller's floating-point environment changes no bit.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/arguments.h"
#include "common/float_environment.h"
#include "grid_scenes_f64.h"

enum { PAIRS_A_ROUND = 100000 };

static bool has_bits_of(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

static tribox_grid_f64 grid_of(uint32_t x, uint32_t y, uint32_t z) { return (tribox_grid_f64){{0, 0, 0}, {1, 1, 1}, {x, y, z}}; }

/* Few bits, so that sums are ties; or many. */
static double draw_number(random_source *r, int exponent)
{
    const double number = random_int(r, 2) ? random_double(r, 1, 2) : 1 + random_int(r, 8) / 8.0;
    return ldexp(random_int(r, 2) ? number : -number, exponent);
}

/* Plane p such that the product is near the origin, far from it, or cancels it. */
static void draw_plane(random_source *r, double *from, double *cell, uint32_t *p)
{
    const int exponent = random_int_between(r, -1074, 990);
    *p = (uint32_t)(random_bits(r) >> random_int_between(r, 32, 63));
    *cell = fabs(draw_number(r, exponent));
    *from = draw_number(r, exponent + random_int_between(r, -70, 120 - (exponent > 900 ? exponent - 900 : 0)));
    if (!random_int(r, 4))
        *from = -(*cell * *p) * (1 + random_int_between(r, -2, 2) * DBL_EPSILON);
    if (!random_int(r, 50))
        *from = random_int(r, 2) ? 0.0 : -0.0;
}

static void test_planes(void **state)
{
    const arguments *const args = *state;
    random_source r = random_named(args->seed, "planes");
    for (size_t round = 0; round < 300000 * arguments_rounds(args, PAIRS_A_ROUND); round++) {
        tribox_grid_f64 grid = grid_of(UINT32_MAX, 1, 1);
        uint32_t p;
        draw_plane(&r, &grid.origin[0], &grid.cell[0], &p);
        const double lo = fma(p, grid.cell[0], grid.origin[0]), hi = fma(p + 1.0, grid.cell[0], grid.origin[0]);
        if (!isfinite(grid.origin[0]) || !isfinite(lo) || !isfinite(hi) || !(grid.cell[0] > 0))
            continue;
        const tribox_box box = tribox_grid_cell_f64(&grid, p, 0, 0);
        if (!has_bits_of(box.lo[0], lo) || !has_bits_of(box.hi[0], hi))
            fail_msg("origin %a, cell %a, cell number %u: %a %a for %a %a", grid.origin[0], grid.cell[0], (unsigned)p, box.lo[0],
                     box.hi[0], lo, hi);
        assert_true(box.lo[1] == 0 && box.hi[2] == 1);
    }
}

/* Three triangles, and what a refusal must not touch. */
static const double points[3][3] = {{-1e6, -1e6, 0}, {1e6, 0, 0}, {0, 1e6, 0}};
static const uint64_t poison = UINT64_C(0xa5a5a5a5a5a5a5a5);

static tribox_mesh wide_mesh(void) { return (tribox_mesh){.positions = points, .vertices = 3, .count = 1, .position_bytes = 8}; }

static void assert_refused(const tribox_mesh *mesh, const tribox_grid_f64 *grid, const uint32_t *first, const uint32_t *size,
                           const tribox_options *options, tribox_status expected)
{
    uint64_t words[4] = {poison, poison, poison, poison};
    tribox_report report = {12345, 67890};
    assert_int_equal(tribox_voxelize_f64(mesh, grid, first, size, options, words, &report), expected);
    for (int w = 0; w < 4; w++)
        assert_true(words[w] == poison);
    assert_true(report.overlapping == 12345 && report.undecided == 67890);
}

static tribox_status status_of(const tribox_grid_f64 *grid)
{
    const tribox_mesh none = {.count = 0};
    static const uint32_t zero[3];
    uint64_t word = 0;
    return tribox_voxelize_f64(&none, grid, zero, zero, NULL, &word, NULL);
}

static void test_bad_grids(void **state)
{
    (void)state;
    const tribox_mesh mesh = wide_mesh();
    static const double bad_cell[] = {0, -0.0, -1, -0x1p-1074, NAN, INFINITY, -INFINITY};
    static const double bad_origin[] = {NAN, INFINITY, -INFINITY};
    for (int a = 0; a < 3; a++) {
        tribox_grid_f64 grid = grid_of(2, 2, 1);
        for (size_t k = 0; k < sizeof bad_cell / sizeof bad_cell[0]; k++) {
            grid.cell[a] = bad_cell[k];
            assert_refused(&mesh, &grid, NULL, NULL, NULL, TRIBOX_BAD_GRID);
        }
        grid.cell[a] = 1;
        for (size_t k = 0; k < sizeof bad_origin / sizeof bad_origin[0]; k++) {
            grid.origin[a] = bad_origin[k];
            assert_refused(&mesh, &grid, NULL, NULL, NULL, TRIBOX_BAD_GRID);
        }
        grid = grid_of(2, 2, 1);
        grid.size[a] = 0;
        assert_refused(&mesh, &grid, NULL, NULL, NULL, TRIBOX_BAD_GRID);
        /* the last plane is not a double, the one before is */
        grid = grid_of(1, 1, 1);
        grid.cell[a] = 0x1p1022;
        grid.size[a] = 3;
        assert_int_equal(status_of(&grid), TRIBOX_OK);
        grid.size[a] = 4;
        assert_int_equal(status_of(&grid), TRIBOX_BAD_GRID);
        grid.origin[a] = -DBL_MAX;
        grid.cell[a] = DBL_MAX;
        grid.size[a] = 2;
        assert_int_equal(status_of(&grid), TRIBOX_OK);
        grid.size[a] = 3;
        assert_int_equal(status_of(&grid), TRIBOX_BAD_GRID);
    }
    /* too many words, unless a window is asked */
    const tribox_grid_f64 grid = grid_of(1, 65536, 32769);
    static const uint32_t first[3] = {0, 0, 0}, layer[3] = {1, 2, 1};
    uint64_t words[2] = {0, 0};
    assert_refused(&mesh, &grid, NULL, NULL, NULL, TRIBOX_BAD_GRID);
    assert_refused(&mesh, &grid, first, grid.size, NULL, TRIBOX_BAD_GRID);
    assert_int_equal(tribox_voxelize_f64(&mesh, &grid, first, layer, NULL, words, NULL), TRIBOX_OK);
    assert_true(words[0] == 1 && words[1] == 1);
}

/* Cells of about the spacing of doubles, with a power of two among the planes. */
static void draw_fine_axis(random_source *r, tribox_grid_f64 *grid, int a)
{
    static const double step[] = {0.25, 0.5, 0.5 + 0x1p-20, 0.75, 1 - 0x1p-53, 1, 1 + 0x1p-52, 1.5, 2, 3};
    const int exponent = random_int(r, 5) ? random_int_between(r, -1020, 1000) : random_int_between(r, -1074, -1015);
    const double mantissa = random_int(r, 2) ? 1 : random_double(r, 1, 2),
                 spacing = ldexp(1, exponent - 52 > -1074 ? exponent - 52 : -1074);
    grid->size[a] = (uint32_t)random_int_between(r, 1, 1 << random_int_between(r, 1, 10));
    grid->cell[a] = spacing * (random_int(r, 4) ? step[random_int(r, 10)] : random_double(r, 0.4, 2.2));
    grid->origin[a] = ldexp(mantissa, exponent) - random_int(r, 16) * spacing / 2;
    if (random_int(r, 2))
        grid->origin[a] = ldexp(mantissa, exponent) - random_int(r, (int)grid->size[a]) * grid->cell[a];
    if (random_int(r, 2))
        grid->origin[a] = -grid->origin[a] - grid->size[a] * grid->cell[a] / random_int_between(r, 1, 3);
}

static void test_fineness(void **state)
{
    const arguments *const args = *state;
    random_source r = random_named(args->seed, "fineness");
    size_t refused = 0, served = 0;
    for (size_t round = 0; round < 60000 * arguments_rounds(args, PAIRS_A_ROUND); round++) {
        const int a = random_int(&r, 3);
        tribox_grid_f64 grid = grid_of(1, 1, 1);
        bool is_rising = true;
        draw_fine_axis(&r, &grid, a);
        if (!(grid.cell[a] > 0))
            continue;
        for (uint32_t p = 0; p < grid.size[a] && is_rising; p++)
            is_rising = fma(p + 1.0, grid.cell[a], grid.origin[a]) > fma(p, grid.cell[a], grid.origin[a]);
        if (status_of(&grid) != (is_rising ? TRIBOX_OK : TRIBOX_BAD_GRID))
            fail_msg("origin %a, cell %a, size %u: planes %s", grid.origin[a], grid.cell[a], (unsigned)grid.size[a],
                     is_rising ? "rise" : "do not rise");
        refused += !is_rising;
        served += is_rising;
    }
    printf("%zu grids refused, %zu served\n", refused, served);
    assert_in_range(refused, 1000, SIZE_MAX);
    assert_in_range(served, 1000, SIZE_MAX);
}

/* As many planes as there can be: told at once. */
static void test_longest(void **state)
{
    (void)state;
    static const struct {
        double origin, cell;
        bool is_sound;
    } of[] = {
        {0, 0.1, true},
        {0x1p52, 1, true},
        {0x1p52 - 3.5, 1, false},
        {0x1p53 - 0x1p31, 1, false},
        {0x1p53 - 9, 1, false},
        {-0x1p53, 1, true},
        {-0x1p53 - 2, 1, false},
        {-0x1p53 - 2, 2, true},
        {0x1p52, 0.9, false},
        {0x1p52, 1 - 0x1p-50, true},
        {0x1p52, 1 - 0x1p-33, true},
        {0x1p52, 1 - 0x1p-32, false},
        {-0x1p-1042, 0x1p-1074, true},
        {0x1p53 - 0x1p31 + 1, 2, false},
        {0x1p53 - 0x1p31, 2, true},
    };
    for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
        const tribox_grid_f64 grid = {{of[k].origin, 0, 0}, {of[k].cell, 1, 1}, {UINT32_MAX, 1, 1}};
        if (status_of(&grid) != (of[k].is_sound ? TRIBOX_OK : TRIBOX_BAD_GRID))
            fail_msg("origin %a, cell %a", of[k].origin, of[k].cell);
    }
}

static void test_bad_arguments(void **state)
{
    (void)state;
    static const uint32_t zero[3] = {0, 0, 0}, one[3] = {1, 1, 1}, numbers[3] = {0, 1, 3};
    const tribox_grid_f64 grid = grid_of(2, 2, 5);
    const tribox_mesh mesh = wide_mesh();
    tribox_mesh bad = mesh;
    tribox_report report = {12345, 67890};
    assert_refused(NULL, &grid, NULL, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    assert_refused(&mesh, NULL, NULL, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    assert_refused(&mesh, &grid, zero, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    assert_refused(&mesh, &grid, NULL, one, NULL, TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_voxelize_f64(&mesh, &grid, NULL, NULL, NULL, NULL, &report), TRIBOX_BAD_ARGUMENT);
    static const uint32_t beyond[][2] = {
        {0, 6}, {5, 1}, {6, 0}, {4, 2}, {1, UINT32_MAX}, {UINT32_MAX, 1}, {UINT32_MAX, UINT32_MAX}};
    for (size_t k = 0; k < sizeof beyond / sizeof beyond[0]; k++)
        assert_refused(&mesh, &grid, (uint32_t[]){0, 0, beyond[k][0]}, (uint32_t[]){1, 1, beyond[k][1]}, NULL, TRIBOX_BAD_ARGUMENT);
    bad.position_bytes = 2;
    assert_refused(&bad, &grid, NULL, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    bad = mesh;
    bad.stride = 23;
    assert_refused(&bad, &grid, NULL, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    bad = mesh;
    bad.vertices = 2;
    assert_refused(&bad, &grid, NULL, NULL, NULL, TRIBOX_BAD_VERTEX);
    bad = mesh;
    bad.indices = numbers;
    bad.index_bytes = 4;
    assert_refused(&bad, &grid, NULL, NULL, NULL, TRIBOX_BAD_VERTEX);
    const tribox_options unknown = {.kernel = "mmx"}, axes = {.axes = 8};
    assert_refused(&mesh, &grid, NULL, NULL, &unknown, TRIBOX_NO_KERNEL);
    assert_refused(&mesh, &grid, NULL, NULL, &axes, TRIBOX_BAD_OPTION);
    /* nothing to do */
    uint64_t word = poison;
    const tribox_mesh none = {.count = 0};
    assert_int_equal(tribox_voxelize_f64(&mesh, &grid, grid.size, zero, NULL, &word, &report), TRIBOX_OK);
    assert_true(word == poison && report.overlapping == 0 && report.undecided == 0);
    assert_int_equal(tribox_voxelize_f64(&none, &grid, zero, one, NULL, &word, &report), TRIBOX_OK);
    assert_true(word == poison && report.overlapping == 0 && report.undecided == 0);
}

static void test_environment(void **state)
{
    const arguments *const args = *state;
    static window_f64 w;
    static uint64_t expected[WINDOW_CELLS + 1], occupied[WINDOW_CELLS + 1];
    random_source r = random_named(args->seed, "environment");
    const unsigned normal = environment_get();
    for (size_t round = 0; round < 4 * scene_f64_count(); round++) {
        const scene_f64 *const scene = scene_f64_at(round % scene_f64_count());
        w = (window_f64){.scene = scene->name, .seed = args->seed, .count = 20};
        draw_grid_f64(&r, scene, 2000, &w.grid);
        for (size_t t = 0; t < w.count; t++)
            draw_triangle_f64(&r, &w.grid, w.triangle[t]);
        window_f64_open(&w);
        window_f64_ask(&w, 0, w.count, expected);
        const tribox_mesh mesh = {.positions = w.triangle, .vertices = 3 * w.count, .count = w.count, .position_bytes = 8};
        const tribox_box right = tribox_grid_cell_f64(&w.grid, 0, 0, 0);
        for (unsigned k = 0; k < SETTINGS; k++) {
            memset(occupied, 0, sizeof occupied);
            environment_set(setting(k));
            const tribox_status status = tribox_voxelize_f64(&mesh, &w.grid, NULL, NULL, NULL, occupied, NULL);
            const tribox_box box = tribox_grid_cell_f64(&w.grid, 0, 0, 0);
            const unsigned left = environment_get();
            environment_set(normal);
            assert_int_equal(status, TRIBOX_OK);
            assert_int_equal(left, setting(k));
            assert_memory_equal(occupied, expected, window_f64_words(&w) * sizeof *occupied);
            assert_memory_equal(&box, &right, sizeof box);
        }
    }
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_planes, &args),        cmocka_unit_test_prestate(test_bad_grids, &args),
        cmocka_unit_test_prestate(test_fineness, &args),      cmocka_unit_test_prestate(test_longest, &args),
        cmocka_unit_test_prestate(test_bad_arguments, &args), cmocka_unit_test_prestate(test_environment, &args),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
