/*
 * test_mesh_f64.c - meshes of every layout in grids in double: the bits of the soup in float where both say the same, however far
 * the mesh and its grid are moved; rows of more cells than 2^31; and the Stanford bunny in UTM coordinates.
 */
#include <math.h>

#include "cells.h"

#include "common/harness.h"
#include "common/real_meshes.h"
#include "common/laid_mesh.h"

enum { CELLS_MAX = 20000, ROUNDS = 60, LAYOUTS = 14, PAIRS_A_ROUND = 100000 };

static cells_case drawn;
static uint64_t expected[CELLS_MAX], occupied[CELLS_MAX];

/* Numbers on a lattice, so that they can be moved without rounding: cells of 1/8, and of vertices those beside them. */
static void draw_lattice_mesh(random_source *r)
{
    const tribox_grid grid = {{-2, 3, 1}, {0.125, 0.125, 0.125}, {40, 25, 20}};
    drawn.grid = grid;
    cells_open(&drawn);
    drawn.count = 0;
    const int count = random_int_between(r, 1, 400);
    while (drawn.count < (size_t)count) {
        const double length = random_int(r, 3) ? 0.4 : random_int(r, 2) ? 1.5 : 9;
        double u[3][3];
        for (int a = 0; a < 3; a++) {
            const double from = grid.origin[a] + random_double(r, -0.5, 5.5);
            for (int j = 0; j < 3; j++) {
                const double x = from + random_double(r, 0, length), step = random_int(r, 2) ? 0.125 : 0x1p-10;
                u[j][a] = floor(x / step) * step;
            }
        }
        cells_put(&drawn, u);
    }
    cells_ask(&drawn, 0, drawn.count, expected);
}

static double moved[CELLS_TRIANGLES][3][3];

static tribox_grid move(const double offset[3])
{
    tribox_grid grid = drawn.grid;
    for (int a = 0; a < 3; a++)
        grid.origin[a] += offset[a];
    for (size_t n = 0; n < 9 * drawn.count; n++)
        moved[n / 9][n / 3 % 3][n % 3] = drawn.u[n / 9][n / 3 % 3][n % 3] + offset[n % 3];
    return grid;
}

static void check_mesh(const tribox_mesh *laid, const tribox_grid *grid, const char *kernel)
{
    const tribox_options options = {.kernel = kernel};
    memset(occupied, 0, sizeof occupied);
    assert_int_equal(tribox_mesh_voxelize(laid, grid, NULL, &options, occupied, NULL), TRIBOX_OK);
    assert_memory_equal(occupied, expected, cells_words(&drawn) * sizeof *occupied);
}

CASE(test_layouts)
{
    static const double far[][3] = {
        {0, 0, 0}, {557820, 5108010, 700}, {-0x1p40, 0x1p41 + 1, 0x1p39 - 0.125}, {4.1e6, -1.13e6, 4.74e6}};
    const laid_fences fences = laid_fences_make(args.seed);
    random_source r = random_named(args.seed, "layouts");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        draw_lattice_mesh(&r);
        for (int k = 0; k < LAYOUTS; k++) {
            const double *const offset = far[k % 4];
            const tribox_grid grid = move(offset);
            const mesh_form form = mesh_form_draw(&r, k % 4 == 0);
            const tribox_mesh laid =
                laid_mesh_of(&r, &form, (const double(*)[3][3])moved, drawn.count, permutations[random_int(&r, ORDERS)], fences);
            check_mesh(&laid, &grid, names[random_int(&r, kernels)]);
        }
    }
}

/* Cells of these by the call about one box. */
static void check_cells(const tribox_mesh *long_one, const tribox_grid *grid, uint32_t first, uint32_t count,
                        const tribox_options *options, const uint64_t *row)
{
    for (uint32_t i = 0; i < count; i++) {
        const tribox_box box = tribox_grid_cell(grid, first + i, 0, 0);
        uint64_t mask;
        assert_int_equal(tribox_mesh_overlap(long_one, &box, options, &mask, NULL), TRIBOX_OK);
        assert_int_equal(mask, row[i / 64] >> i % 64 & 1);
    }
}

/*
 * A row whose cells have numbers beyond 2^31, and triangles that leave it: a small one, and one as long as the row. A plane alone,
 * at the end of the row.
 */
CASE(test_long_rows)
{
    static const double triangles_of[2][3][3] = {{{-7.5, 0.5, 0.5}, {9.25, 0.75, -0.5}, {3, -0.5, 0.75}},
                                                 {{-0x1p31, -0x1p29, 0.25}, {0x1p31, 0x1p29, 0.5}, {0x1p31, 0x1p29, -7}}};
    const uint32_t size = UINT32_MAX - 50, first = 0x7fffffc0, end = UINT32_MAX - 140, part = 140;
    const tribox_window whole = {{0, 0, 0}, {size, 1, 1}}, middle = {{first, 0, 0}, {part, 1, 1}},
                        last = {{end, 0, 0}, {part, 1, 1}};
    const tribox_grid grid = {{-0x1p31, 0, 0}, {1, 1, 1}, {UINT32_MAX, 1, 1}};
    const tribox_options plane = {.axes = TRIBOX_AXES_PLANE};
    uint64_t *const row = calloc(size / 64 + 1, sizeof *row);
    if (!row)
        skip();
    for (int t = 0; t < 2; t++) {
        const tribox_mesh long_one = mesh_of_corners(triangles_of[t], 1, 8);
        uint64_t window[3] = {0}, far[3] = {0};
        tribox_report report, report_of_window;
        assert_int_equal(tribox_mesh_voxelize(&long_one, &grid, &whole, NULL, row, &report), TRIBOX_OK);
        assert_int_equal(tribox_mesh_voxelize(&long_one, &grid, &middle, NULL, window, &report_of_window), TRIBOX_OK);
        assert_in_range(report.overlapping, 4, 20);
        assert_int_equal(report_of_window.overlapping, report.overlapping);
        assert_memory_equal(row + first / 64, window, sizeof window);
        check_cells(&long_one, &grid, first, part, NULL, window);
        assert_int_equal(tribox_mesh_voxelize(&long_one, &grid, &last, &plane, far, NULL), TRIBOX_OK);
        check_cells(&long_one, &grid, end, part, &plane, far);
        memset(row + first / 64, 0, sizeof window);
    }
    free(row);
}

/* The longest side made 20 m, moved to a place in UTM, in cells of half a metre from its lowest corner. */
CASE(test_bunny)
{
    static const double offset[3] = {557820, 5108010, 700};
    char path[4096];
    mesh m;
    if (!args.meshes)
        skip();
    assert_in_range(snprintf(path, sizeof path, "%s/stanford-bunny.ply", args.meshes), 1, sizeof path - 1);
    assert_true(mesh_read(path, &m));
    const tribox_box bounds = mesh_bounds(&m);
    double longest = 0, (*u)[3][3] = calloc(m.count, sizeof *u);
    assert_non_null(u);
    tribox_grid grid = {.cell = {0.5, 0.5, 0.5}};
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, (double)bounds.hi[a] - (double)bounds.lo[a]);
    for (int a = 0; a < 3; a++) {
        const double scale = 20 / longest, low = (double)bounds.lo[a];
        double highest = offset[a];
        for (size_t i = 0; i < m.count; i++)
            for (int j = 0; j < 3; j++) {
                u[i][j][a] = ((double)m.coordinate[j][a][i] - low) * scale + offset[a];
                highest = fmax(highest, u[i][j][a]);
            }
        grid.origin[a] = offset[a];
        grid.size[a] = (uint32_t)ceil((highest - grid.origin[a]) / grid.cell[a]);
    }
    const tribox_mesh utm = mesh_of_corners(u, m.count, 8);
    const size_t words = (size_t)((grid.size[0] + 63) / 64) * grid.size[1] * grid.size[2];
    uint64_t *const cells = cells_make(words);
    tribox_report report;
    assert_int_equal(tribox_mesh_voxelize(&utm, &grid, NULL, NULL, cells, &report), TRIBOX_OK);
    printf("%u x %u x %u cells, %zu set\n", (unsigned)grid.size[0], (unsigned)grid.size[1], (unsigned)grid.size[2],
           report.overlapping);
    assert_int_equal(report.overlapping, 5379);
    free(cells);
    free(u);
    mesh_free(&m);
}

PROGRAM(RUN(test_layouts), RUN(test_long_rows), RUN(test_bunny))
