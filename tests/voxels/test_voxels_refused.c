/*
 * test_voxels_refused.c - what cannot be voxelized is refused, a soup and a mesh alike, with nothing written; and what lies just
 * this side of it is not.
 */
#include "occupancy.h"

#include <string.h>

#include "common/guard.h"

static tribox_grid grid_of(uint32_t x, uint32_t y, uint32_t z) { return (tribox_grid){{0, 0, 0}, {1, 1, 1}, {x, y, z}}; }

/* A triangle over all of every grid near the origin, and the words and report that no refusal touches. */
static const float corner[3][3] = {{-1e6f, -1e6f, 0}, {1e6f, 0, 0}, {0, 1e6f, 0}};
static const double wide_corner[3][3] = {{-1e6, -1e6, 0}, {1e6, 0, 0}, {0, 1e6, 0}};
static const uint64_t poison = UINT64_C(0xa5a5a5a5a5a5a5a5);

static tribox_soup wide_soup(void)
{
    tribox_soup soup = {.count = 1};
    for (int v = 0; v < 3; v++) {
        soup.x[v] = &corner[v][0];
        soup.y[v] = &corner[v][1];
        soup.z[v] = &corner[v][2];
    }
    return soup;
}

static tribox_mesh wide_mesh(unsigned position_bytes)
{
    const void *const positions = position_bytes == 8 ? (const void *)wide_corner : corner;
    return (tribox_mesh){.positions = positions, .vertices = 3, .count = 1, .position_bytes = position_bytes};
}

/* One of the two is asked. */
static void assert_refused_by(const tribox_soup *soup, const tribox_mesh *mesh, bool is_soup, const tribox_grid *grid,
                              const tribox_window *window, const tribox_options *options, tribox_status expected)
{
    uint64_t words[4] = {poison, poison, poison, poison};
    tribox_report report = {12345, 67890};
    const tribox_status status = is_soup ? tribox_voxelize(soup, grid, window, options, words, &report)
                                         : tribox_mesh_voxelize(mesh, grid, window, options, words, &report);
    if (status != expected && grid)
        grid_planes_print(stderr, grid);
    assert_int_equal(status, expected);
    for (int w = 0; w < 4; w++)
        assert_true(words[w] == poison);
    assert_true(report.overlapping == 12345 && report.undecided == 67890);
}

static void assert_soup_refused(const tribox_soup *soup, tribox_status expected)
{
    const tribox_grid grid = grid_of(2, 2, 1);
    assert_refused_by(soup, NULL, true, &grid, NULL, NULL, expected);
}

static void assert_mesh_refused(const tribox_mesh *mesh, tribox_status expected)
{
    const tribox_grid grid = grid_of(2, 2, 1);
    assert_refused_by(NULL, mesh, false, &grid, NULL, NULL, expected);
}

/* Whatever triangles are asked about. */
static void assert_refused(const tribox_grid *grid, const tribox_window *window, const tribox_options *options,
                           tribox_status expected)
{
    const tribox_soup soup = wide_soup();
    const tribox_mesh floats = wide_mesh(0), doubles = wide_mesh(8);
    assert_refused_by(&soup, NULL, true, grid, window, options, expected);
    assert_refused_by(NULL, &floats, false, grid, window, options, expected);
    assert_refused_by(NULL, &doubles, false, grid, window, options, expected);
}

static void test_too_large(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup();
    const tribox_mesh mesh = wide_mesh(8);
    const tribox_grid bad[] = {
        grid_of(1, 65536, 32769),         grid_of(64, 32769, 65536),           grid_of(65, 32768, 32769),
        grid_of(129, 65536, 65536),       grid_of(1, 4194304, 4194304),        grid_of(4194304, 4194304, 4194304),
        grid_of(UINT32_MAX, 1u << 20, 1), grid_of(UINT32_MAX, UINT32_MAX, 65), grid_of(UINT32_MAX, UINT32_MAX, UINT32_MAX),
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        assert_refused(&bad[k], NULL, NULL, TRIBOX_BAD_GRID);
    /* a window of it fits */
    const tribox_window whole = {{0, 0, 0}, {1, 65536, 32769}}, few = {{0, 0, 0}, {1, 2, 1}},
                        layer = {{0, 0, 32768}, {1, 65536, 1}};
    static uint64_t words[1 << 16];
    assert_refused(&bad[0], &whole, NULL, TRIBOX_BAD_GRID);
    assert_int_equal(tribox_mesh_voxelize(&mesh, &bad[0], &few, NULL, words, NULL), TRIBOX_OK);
    assert_true(words[0] == 1 && words[1] == 1);
    memset(words, 0, sizeof words);
    assert_int_equal(tribox_voxelize(&soup, &bad[0], &layer, NULL, words, NULL), TRIBOX_OK);
    assert_int_equal(occupancy_count(words, 1 << 16), 0);
}

static void test_bad_windows(void **state)
{
    (void)state;
    const tribox_grid grid = grid_of(2, 2, 5);
    const tribox_soup soup = wide_soup();
    static const uint32_t bad[][2] = {{0, 6}, {5, 1}, {6, 0}, {4, 2}, {1, UINT32_MAX}, {UINT32_MAX, 1}, {UINT32_MAX, UINT32_MAX}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        assert_refused(&grid, &(tribox_window){{0, 0, bad[k][0]}, {2, 2, bad[k][1]}}, NULL, TRIBOX_BAD_ARGUMENT);
        assert_refused(&grid, &(tribox_window){{0, 0, bad[k][0]}, {1, 1, bad[k][1]}}, NULL, TRIBOX_BAD_ARGUMENT);
    }
    uint64_t words[10] = {0};
    for (uint32_t first = 0; first <= 5; first++)
        assert_int_equal(tribox_voxelize(&soup, &grid, &(tribox_window){{0, 0, first}, {2, 2, 0}}, NULL, words, NULL), TRIBOX_OK);
    assert_int_equal(occupancy_count(words, 10), 0);
    assert_int_equal(tribox_voxelize(&soup, &grid, &(tribox_window){{0, 0, 0}, {2, 2, 5}}, NULL, words, NULL), TRIBOX_OK);
    assert_true(occupancy_count(words, 10) > 0);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    const tribox_soup soup = wide_soup(), none = {.count = 0};
    const tribox_mesh mesh = wide_mesh(8), no_mesh = {.count = 0};
    const tribox_grid grid = grid_of(2, 2, 1);
    uint64_t words[4] = {0};
    tribox_report report = {12345, 67890};
    assert_soup_refused(NULL, TRIBOX_BAD_ARGUMENT);
    assert_mesh_refused(NULL, TRIBOX_BAD_ARGUMENT);
    assert_refused(NULL, NULL, NULL, TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, NULL, NULL, &report), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, NULL, NULL, NULL, &report), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(report.overlapping, 12345);
    for (int j = 0; j < 3; j++) {
        tribox_soup x = soup, y = soup, z = soup;
        x.x[j] = y.y[j] = z.z[j] = NULL;
        assert_soup_refused(&x, TRIBOX_BAD_ARGUMENT);
        assert_soup_refused(&y, TRIBOX_BAD_ARGUMENT);
        assert_soup_refused(&z, TRIBOX_BAD_ARGUMENT);
    }
    tribox_soup endless = soup;
    endless.count = SIZE_MAX;
    assert_soup_refused(&endless, TRIBOX_BAD_ARGUMENT);
    endless.count = (size_t)PTRDIFF_MAX / sizeof(float) + 1;
    assert_soup_refused(&endless, TRIBOX_BAD_ARGUMENT);
    /* nothing to do */
    assert_int_equal(tribox_voxelize(&none, &grid, NULL, NULL, words, &report), TRIBOX_OK);
    assert_true(report.overlapping == 0 && report.undecided == 0);
    assert_int_equal(tribox_mesh_voxelize(&no_mesh, &grid, NULL, NULL, words, &report), TRIBOX_OK);
    assert_true(report.overlapping == 0 && report.undecided == 0);
    assert_int_equal(occupancy_count(words, 4), 0);
    assert_int_equal(tribox_voxelize(&soup, &grid, NULL, NULL, words, NULL), TRIBOX_OK);
    assert_true(occupancy_count(words, 4) > 0);
}

static void test_bad_meshes(void **state)
{
    (void)state;
    static const uint32_t numbers[3] = {0, 1, 3};
    for (unsigned bytes = 4; bytes <= 8; bytes += 4) {
        const tribox_mesh mesh = wide_mesh(bytes);
        tribox_mesh bad = mesh;
        bad.position_bytes = 2;
        assert_mesh_refused(&bad, TRIBOX_BAD_ARGUMENT);
        bad = mesh;
        bad.stride = 3 * bytes - 1;
        assert_mesh_refused(&bad, TRIBOX_BAD_ARGUMENT);
        bad = mesh;
        bad.reserved[3] = 1;
        assert_mesh_refused(&bad, TRIBOX_BAD_ARGUMENT);
        bad = mesh;
        bad.vertices = 2;
        assert_mesh_refused(&bad, TRIBOX_BAD_VERTEX);
        bad = mesh;
        bad.indices = numbers;
        bad.index_bytes = 4;
        assert_mesh_refused(&bad, TRIBOX_BAD_VERTEX);
    }
}

static void test_bad_options(void **state)
{
    (void)state;
    const tribox_grid grid = grid_of(2, 2, 1);
    const tribox_options bad[] = {
        {.accuracy = (tribox_accuracy)3}, {.axes = 8}, {.axes = ~0u}, {.axis_order = 122}, {.axis_order = 1}, {.reserved = {0, 1}}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        assert_refused(&grid, NULL, &bad[k], TRIBOX_BAD_OPTION);
    const tribox_options unknown = {.kernel = "mmx"}, empty = {.kernel = ""};
    assert_refused(&grid, NULL, &unknown, TRIBOX_NO_KERNEL);
    assert_refused(&grid, NULL, &empty, TRIBOX_NO_KERNEL);
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
        assert_int_equal(tribox_voxelize(&soup, &grid, NULL, &exact, words, &report), TRIBOX_OK);
        assert_in_range(report.undecided, axes == TRIBOX_AXES_ALL, 64);
        assert_int_equal(tribox_voxelize(&soup, &grid, NULL, &fast, words, &report), TRIBOX_OK);
        assert_int_equal(report.undecided, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_too_large),  cmocka_unit_test(test_bad_windows), cmocka_unit_test(test_bad_arguments),
        cmocka_unit_test(test_bad_meshes), cmocka_unit_test(test_bad_options), cmocka_unit_test(test_undecided),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
