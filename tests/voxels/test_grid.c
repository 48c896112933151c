/*
 * test_grid.c - the cells of a grid are what tribox.h says, neighbours share their faces to the bit, sizes in words saturate, and
 * every grid that cannot be served is refused with nothing written.
 */
#include "occupancy.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "common/arguments.h"
#include "grid_kinds.h"
#include "cell_oracle.h"
#include "triangle_kinds.h"

enum { CELLS_MAX = 8000, PAIRS_A_ROUND = 100000 };

static grid_planes at;

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* To the bit, the sign of a zero too. */
static void assert_boxes_equal(const tribox_box *a, const tribox_box *b)
{
    for (int k = 0; k < 3; k++) {
        assert_int_equal(bits_of(a->lo[k]), bits_of(b->lo[k]));
        assert_int_equal(bits_of(a->hi[k]), bits_of(b->hi[k]));
    }
}

static void test_cells(void **state)
{
    const arguments *const args = *state;
    random_source r = random_named(args->seed, "cells");
    for (size_t round = 0; round < 30 * grid_kind_count(); round++) {
        draw_grid_of_kind(&r, grid_kind_at(round % grid_kind_count()), CELLS_MAX, &at);
        for (int n = 0; n < 200; n++) {
            int cell[3];
            for (int a = 0; a < 3; a++)
                cell[a] = random_int(&r, (int)at.grid.size[a]);
            const tribox_box box = tribox_grid_cell(&at.grid, (uint32_t)cell[0], (uint32_t)cell[1], (uint32_t)cell[2]);
            const tribox_box expected = grid_planes_cell(&at, cell[0], cell[1], cell[2]);
            assert_boxes_equal(&box, &expected);
            for (int a = 0; a < 3; a++) {
                uint32_t next[3] = {(uint32_t)cell[0], (uint32_t)cell[1], (uint32_t)cell[2]};
                if (++next[a] == at.grid.size[a])
                    continue;
                const tribox_box neighbour = tribox_grid_cell(&at.grid, next[0], next[1], next[2]);
                assert_int_equal(bits_of(box.hi[a]), bits_of(neighbour.lo[a]));
            }
        }
    }
}

static tribox_grid grid_of(uint32_t x, uint32_t y, uint32_t z) { return (tribox_grid){{0, 0, 0}, {1, 1, 1}, {x, y, z}}; }

static void test_words(void **state)
{
    (void)state;
    static const uint32_t sizes[] = {0, 1, 2, 63, 64, 65, 127, 128, 129, 4096, 65536, UINT32_MAX - 63, UINT32_MAX};
    const size_t count = sizeof sizes / sizeof sizes[0];
    for (size_t x = 0; x < count; x++)
        for (size_t y = 0; y < count; y++)
            for (size_t z = 0; z < count; z++) {
                const tribox_grid grid = grid_of(sizes[x], sizes[y], sizes[z]);
                const size_t row = ((size_t)sizes[x] + 63) / 64;
                size_t words;
                assert_int_equal(tribox_grid_row_words(&grid), row);
                if (__builtin_mul_overflow(row, (size_t)sizes[y], &words) ||
                    __builtin_mul_overflow(words, (size_t)sizes[z], &words))
                    words = SIZE_MAX;
                if (row && sizes[y] && sizes[z])
                    assert_true(tribox_grid_words(&grid) == words);
            }
}

/* A triangle over all of every grid near the origin, and the words and report that no refusal touches. */
static const float whole[3] = {-1e6f, 1e6f, 0};
static const uint64_t poison = UINT64_C(0xa5a5a5a5a5a5a5a5);

static tribox_soup wide_soup(void)
{
    return (tribox_soup){
        {&whole[0], &whole[1], &whole[2]}, {&whole[0], &whole[2], &whole[1]}, {&whole[2], &whole[2], &whole[2]}, 1};
}

static void assert_refused(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options, tribox_status expected)
{
    uint64_t words[4] = {poison, poison, poison, poison};
    tribox_report report = {12345, 67890};
    for (int is_layers = 0; is_layers < 2; is_layers++) {
        const tribox_status status = is_layers
                                         ? tribox_voxelize_layers(soup, grid, 0, grid ? grid->size[2] : 0, options, words, &report)
                                         : tribox_voxelize(soup, grid, options, words, &report);
        if (status != expected && grid)
            grid_planes_print(stderr, grid);
        assert_int_equal(status, expected);
        for (int w = 0; w < 4; w++)
            assert_true(words[w] == poison);
        assert_int_equal(report.overlapping, 12345);
        assert_int_equal(report.undecided, 67890);
    }
    if (expected == TRIBOX_BAD_GRID) {
        const tribox_soup none = {.count = 0};
        assert_int_equal(tribox_voxelize(&none, grid, options, words, &report), TRIBOX_BAD_GRID);
    }
}

/* Either refused, or accepted with words enough: here rows along the axis that is not tried are one cell. */
static tribox_status status_of(const tribox_grid *grid)
{
    static uint64_t words[CELLS_MAX];
    const tribox_soup none = {.count = 0};
    return tribox_voxelize(&none, grid, NULL, words, NULL);
}

static void test_bad_numbers(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup();
    const float bad_cell[] = {0, -0.0f, -1, -FLT_MIN, -0x1p-149f, NAN, -NAN, INFINITY, -INFINITY};
    const float bad_origin[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (int a = 0; a < 3; a++) {
        for (size_t k = 0; k < sizeof bad_cell / sizeof bad_cell[0]; k++) {
            tribox_grid grid = grid_of(2, 2, 1);
            grid.cell[a] = bad_cell[k];
            assert_refused(&soup, &grid, NULL, TRIBOX_BAD_GRID);
        }
        for (size_t k = 0; k < sizeof bad_origin / sizeof bad_origin[0]; k++) {
            tribox_grid grid = grid_of(2, 2, 1);
            grid.origin[a] = bad_origin[k];
            assert_refused(&soup, &grid, NULL, TRIBOX_BAD_GRID);
        }
        tribox_grid grid = grid_of(2, 2, 1);
        grid.size[a] = 0;
        assert_refused(&soup, &grid, NULL, TRIBOX_BAD_GRID);
        /* the last plane is not a float, the one before is */
        grid = grid_of(1, 1, 1);
        grid.size[a] = 3;
        grid.cell[a] = 0x1p126f;
        assert_int_equal(status_of(&grid), TRIBOX_OK);
        grid.size[a] = 4;
        assert_refused(&soup, &grid, NULL, TRIBOX_BAD_GRID);
        grid.origin[a] = -FLT_MAX;
        grid.cell[a] = FLT_MAX;
        grid.size[a] = 2;
        assert_int_equal(status_of(&grid), TRIBOX_OK);
        grid.size[a] = 3;
        assert_refused(&soup, &grid, NULL, TRIBOX_BAD_GRID);
    }
}

static void test_too_large(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup();
    const tribox_grid bad[] = {
        grid_of(1, 65536, 32769),         grid_of(64, 32769, 65536),           grid_of(65, 32768, 32769),
        grid_of(129, 65536, 65536),       grid_of(1, 4194304, 4194304),        grid_of(4194304, 4194304, 4194304),
        grid_of(UINT32_MAX, 1u << 20, 1), grid_of(UINT32_MAX, UINT32_MAX, 65), grid_of(UINT32_MAX, UINT32_MAX, UINT32_MAX),
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        assert_refused(&soup, &bad[k], NULL, TRIBOX_BAD_GRID);
    /* just not too large: a slab of it fits */
    const tribox_grid good = grid_of(1, 65536, 32768), row = grid_of(1u << 24, 1, 1);
    static uint64_t layer[1 << 18];
    assert_int_equal(tribox_voxelize_layers(&soup, &good, 32767, 1, NULL, layer, NULL), TRIBOX_OK);
    assert_int_equal(occupancy_count(layer, 1 << 18), 0);
    assert_int_equal(tribox_voxelize_layers(&soup, &good, 0, 1, NULL, layer, NULL), TRIBOX_OK);
    assert_true(occupancy_count(layer, 1 << 18) > 0);
    assert_int_equal(tribox_voxelize(&soup, &row, NULL, layer, NULL), TRIBOX_OK);
    /* two planes of 2^24 + 1 are one float, and only the last two */
    const tribox_grid too_long = grid_of((1u << 24) + 1, 1, 1);
    assert_refused(&soup, &too_long, NULL, TRIBOX_BAD_GRID);
}

/* Cells of about the spacing of floats: a grid is served if, and only if, all planes differ, and then answered right. */
static void test_fineness(void **state)
{
    const arguments *const args = *state;
    random_source r = random_named(args->seed, "fineness");
    size_t refused = 0, served = 0;
    /* the planes that coincide lie at the first, not at the last */
    const tribox_grid fine = {{-1, 0, 0}, {0x1p-25f, 1, 1}, {33554432, 1, 1}};
    assert_int_equal(status_of(&fine), TRIBOX_BAD_GRID);
    for (size_t round = 0; round < 20000 * arguments_rounds(args, PAIRS_A_ROUND); round++) {
        const int a = random_int(&r, 3), exponent = random_int_between(&r, -149, 100);
        tribox_grid grid = grid_of(1, 1, 1);
        grid.size[a] = (uint32_t)random_int_between(&r, 1, 1 << random_int_between(&r, 1, 10));
        const double mantissa = random_int(&r, 2) ? 1 : random_double(&r, 1, 2),
                     spacing = ldexp(1, exponent - 23 > -149 ? exponent - 23 : -149);
        static const double step[] = {0.25, 0.5, 0.5 + 0x1p-20, 0.75, 1 - 0x1p-24, 1, 1 + 0x1p-23, 1.5, 2, 3};
        grid.origin[a] = (float)(ldexp(mantissa, exponent) - random_int(&r, 8) * spacing / 2);
        if (random_int(&r, 2))
            grid.origin[a] = (float)(-(double)grid.origin[a] - (double)grid.size[a] / 2 * spacing);
        grid.cell[a] = (float)(spacing * (random_int(&r, 4) ? step[random_int(&r, 10)] : random_double(&r, 0.4, 2.2)));
        if (!(grid.cell[a] > 0))
            continue;
        const bool is_sound = grid_planes_make(&at, &grid);
        if (status_of(&grid) != (is_sound ? TRIBOX_OK : TRIBOX_BAD_GRID)) {
            grid_planes_print(stderr, &grid);
            fail_msg("the grid is %s, and the library says otherwise", is_sound ? "sound" : "too fine");
        }
        refused += !is_sound;
        served += is_sound;
        if (!is_sound || round % 4)
            continue;
        static triangle_list triangles;
        static uint64_t expected[CELLS_MAX], occupied[CELLS_MAX];
        request q = {.scene = "fineness", .seed = args->seed, .at = &at, .triangles = &triangles};
        float u[3][3];
        draw_triangle(&r, triangle_kind_at((size_t)random_int(&r, (int)triangle_kind_count())), &at, u);
        triangles.count = 0;
        triangle_list_put(&triangles, (const_vertices)u);
        memset(expected, 0, at.words * sizeof *expected);
        occupancy_add(&at, (const_vertices)u, TRIBOX_AXES_ALL, expected);
        request_ask(&q, 0, 1, occupied);
        request_check_exact(&q, 0, 1, expected, occupied);
    }
    printf("%zu grids refused, %zu served\n", refused, served);
    assert_in_range(refused, 1000, SIZE_MAX);
    assert_in_range(served, 1000, SIZE_MAX);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup(), none = {.count = 0};
    const tribox_grid grid = grid_of(2, 2, 1);
    uint64_t words[4] = {0};
    assert_refused(NULL, &grid, NULL, TRIBOX_BAD_ARGUMENT);
    assert_refused(&soup, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    tribox_report report = {12345, 67890};
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, NULL, &report), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_voxelize_layers(&soup, &grid, 0, 1, NULL, NULL, &report), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(report.overlapping, 12345);
    for (int j = 0; j < 3; j++) {
        tribox_soup x = soup, y = soup, z = soup;
        x.x[j] = y.y[j] = z.z[j] = NULL;
        assert_refused(&x, &grid, NULL, TRIBOX_BAD_ARGUMENT);
        assert_refused(&y, &grid, NULL, TRIBOX_BAD_ARGUMENT);
        assert_refused(&z, &grid, NULL, TRIBOX_BAD_ARGUMENT);
    }
    tribox_soup endless = soup;
    endless.count = SIZE_MAX;
    assert_refused(&endless, &grid, NULL, TRIBOX_BAD_ARGUMENT);
    endless.count = (size_t)PTRDIFF_MAX / sizeof(float) + 1;
    assert_refused(&endless, &grid, NULL, TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_voxelize(&none, &grid, NULL, words, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, 0);
    assert_int_equal(report.undecided, 0);
    assert_int_equal(occupancy_count(words, 4), 0);
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, words, NULL), TRIBOX_OK);
    assert_int_equal(occupancy_count(words, 4), 4);
}

static void test_bad_options(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup();
    const tribox_grid grid = grid_of(2, 2, 1);
    const tribox_options bad[] = {
        {.accuracy = (tribox_accuracy)3}, {.axes = 8}, {.axes = ~0u}, {.axis_order = 122}, {.axis_order = 1}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        assert_refused(&soup, &grid, &bad[k], TRIBOX_BAD_OPTION);
    const tribox_options unknown = {.kernel = "mmx"}, empty = {.kernel = ""};
    assert_refused(&soup, &grid, &unknown, TRIBOX_NO_KERNEL);
    assert_refused(&soup, &grid, &empty, TRIBOX_NO_KERNEL);
}

static void test_layers_beyond(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup();
    const tribox_grid grid = grid_of(2, 2, 5);
    static const uint32_t bad[][2] = {{0, 6}, {5, 1}, {6, 0}, {4, 2}, {1, UINT32_MAX}, {UINT32_MAX, 1}, {UINT32_MAX, UINT32_MAX}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        uint64_t words[10] = {0};
        tribox_report report = {12345, 67890};
        assert_int_equal(tribox_voxelize_layers(&soup, &grid, bad[k][0], bad[k][1], NULL, words, &report), TRIBOX_BAD_ARGUMENT);
        assert_int_equal(occupancy_count(words, 10), 0);
        assert_int_equal(report.overlapping, 12345);
    }
    uint64_t words[10] = {0};
    for (uint32_t first = 0; first <= 5; first++)
        assert_int_equal(tribox_voxelize_layers(&soup, &grid, first, 0, NULL, words, NULL), TRIBOX_OK);
    assert_int_equal(occupancy_count(words, 10), 0);
    assert_int_equal(tribox_voxelize_layers(&soup, &grid, 0, 5, NULL, words, NULL), TRIBOX_OK);
}

/* A triangle in the plane x + y = 2 meets cells in edges alone, which goes to a slower stage; of that FAST is silent. */
static void test_undecided(void **state)
{
    (void)state;
    static const float x[3] = {2.25f, -0.25f, 1.25f}, y[3] = {-0.25f, 2.25f, 0.75f}, z[3] = {0.5f, 0.25f, 3.7f};
    const tribox_soup soup = {{x, x + 1, x + 2}, {y, y + 1, y + 2}, {z, z + 1, z + 2}, 1};
    const tribox_grid grid = grid_of(4, 4, 4);
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        const tribox_options exact = {.axes = axes}, fast = {.axes = axes, .accuracy = TRIBOX_FAST};
        uint64_t words[16] = {0};
        tribox_report report;
        assert_int_equal(tribox_voxelize(&soup, &grid, &exact, words, &report), TRIBOX_OK);
        assert_in_range(report.undecided, axes == TRIBOX_AXES_ALL, 64);
        assert_int_equal(tribox_voxelize(&soup, &grid, &fast, words, &report), TRIBOX_OK);
        assert_int_equal(report.undecided, 0);
    }
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_cells, &args),       cmocka_unit_test_prestate(test_words, &args),
        cmocka_unit_test_prestate(test_bad_numbers, &args), cmocka_unit_test_prestate(test_too_large, &args),
        cmocka_unit_test_prestate(test_fineness, &args),    cmocka_unit_test_prestate(test_bad_arguments, &args),
        cmocka_unit_test_prestate(test_bad_options, &args), cmocka_unit_test_prestate(test_layers_beyond, &args),
        cmocka_unit_test_prestate(test_undecided, &args),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
