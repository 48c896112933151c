/*
 * test_large.c - grids of many rows, and of rows as long as float allows: the cells around points of the triangle, inside, on its
 * edges and at its vertices, against the oracle; and the same bits from every kernel.
 */
#include "occupancy.h"

#include <math.h>

#include "common/harness.h"
#include "cell_oracle.h"

enum { POINTS = 1000, PAIRS_A_ROUND = 100000 };

static const tribox_grid grids[] = {
    {{-1, -1, -1}, {1.0f / 1024, 1.0f / 1024, 1.0f / 1024}, {3, 2048, 2048}},
    {{0.1f, -30, 7}, {0.3f, 0.01f, 0.01f}, {70, 1500, 1201}},
    {{-100, 50, -100}, {0.1f, 0.7f, 0.003f}, {1, 3, 300001}},
    {{-100, 50, -100}, {0.1f, 0.003f, 0.7f}, {2, 200003, 3}},
    {{-16777216, 0, 0}, {1, 1, 1}, {33554432, 1, 1}},
    {{-16777216, 0, 0}, {1, 1, 1}, {33554431, 2, 2}},
    {{-5, -5, -5}, {1e-5f, 1, 1}, {1000000, 7, 5}},
};

/* Vertices within or about the grid. */
static void draw_triangle(random_source *r, const tribox_grid *grid, float u[3][3])
{
    const double shrink[3] = {random_int(r, 2) ? 1 : 0.01, random_int(r, 2) ? 1 : 0.01, random_int(r, 2) ? 1 : 0.01};
    const bool is_whole = random_int(r, 3) == 0;
    double base[3];
    for (int a = 0; a < 3; a++)
        base[a] = random_double(r, 0, 1 - shrink[a] / 2);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const double at = grid->size[a] * (base[a] + shrink[a] * random_double(r, -0.2, 1.2));
            u[j][a] = grid_planes_place(grid, a, is_whole ? floor(at) : at);
        }
}

/* One weight or two are often zero. */
static void draw_point(random_source *r, const float u[3][3], double p[3])
{
    double weight[3], sum = 0;
    for (int j = 0; j < 3; j++)
        sum += weight[j] = random_int(r, 3) ? random_double(r, 0, 1) : 0;
    if (sum <= 0)
        sum = weight[0] = 1;
    for (int a = 0; a < 3; a++)
        p[a] = (weight[0] * u[0][a] + weight[1] * u[1][a] + weight[2] * u[2][a]) / sum;
}

static bool is_set(const tribox_grid *grid, const uint64_t *occupied, const int64_t cell[3])
{
    const size_t row = (size_t)cell[2] * grid->size[1] + (size_t)cell[1];
    return occupied[row * ((grid->size[0] + 63) / 64) + (size_t)cell[0] / 64] >> cell[0] % 64 & 1;
}

static void check_cell(const origin *where, const tribox_grid *grid, const cell_oracle *t, const uint64_t *occupied,
                       const int64_t cell[3])
{
    for (int a = 0; a < 3; a++)
        if (cell[a] < 0 || cell[a] >= grid->size[a])
            return;
    const tribox_box box = tribox_grid_cell(grid, (uint32_t)cell[0], (uint32_t)cell[1], (uint32_t)cell[2]);
    const bool answer = is_set(grid, occupied, cell);
    if (answer == cell_oracle_overlaps(t, &box, TRIBOX_AXES_ALL))
        return;
    pair_f32 pair = {.box = box};
    memcpy(pair.u, t->u, sizeof pair.u);
    grid_planes_print(stderr, grid);
    fail_pair(where, &pair, answer);
}

static void check_about(const origin *where, const tribox_grid *grid, const cell_oracle *t, const uint64_t *occupied,
                        const double p[3])
{
    int64_t middle[3];
    for (int a = 0; a < 3; a++)
        middle[a] = (int64_t)floor((p[a] - grid->origin[a]) / grid->cell[a]);
    for (int64_t k = -1; k <= 1; k++)
        for (int64_t j = -1; j <= 1; j++)
            for (int64_t i = -2; i <= 2; i++)
                check_cell(where, grid, t, occupied, (const int64_t[]){middle[0] + i, middle[1] + j, middle[2] + k});
}

static size_t try_triangle(random_source *r, origin *where, const tribox_grid *grid, uint64_t *first, uint64_t *occupied)
{
    const size_t words = tribox_window_words(grid->size);
    triangle_list c = {.count = 0};
    float u[3][3];
    draw_triangle(r, grid, u);
    triangle_list_put(&c, (const_vertices)u);
    const tribox_soup soup = triangle_list_soup(&c);
    tribox_report report;
    for (int kernel = 0; kernel < kernels; kernel++) {
        uint64_t *const words_of = kernel ? occupied : first;
        where->options = (tribox_options){.kernel = names[kernel], .axes = TRIBOX_AXES_ALL};
        memset(words_of, 0, words * sizeof *words_of);
        assert_int_equal(tribox_voxelize(&soup, grid, NULL, &where->options, words_of, &report), TRIBOX_OK);
        assert_int_equal(report.overlapping, occupancy_count(words_of, words));
        if (kernel && memcmp(first, occupied, words * sizeof *first))
            fail_msg("kernels %s and %s differ", names[0], names[kernel]);
    }
    const cell_oracle t = cell_oracle_make((const_vertices)u);
    for (int k = 0; k < POINTS; k++) {
        double p[3];
        draw_point(r, (const_vertices)u, p);
        check_about(where, grid, &t, first, p);
    }
    return report.overlapping;
}

CASE(test_large)
{
    for (size_t g = 0; g < sizeof grids / sizeof grids[0]; g++) {
        const tribox_grid *const grid = &grids[g];
        random_source r = random_named(args.seed + g, "large");
        origin where = {.scene = "large", .seed = args.seed, .function = "tribox_voxelize"};
        const size_t words = tribox_window_words(grid->size);
        uint64_t *const first = occupancy_make(words), *const occupied = occupancy_make(words);
        size_t set = 0;
        for (size_t k = 0; k < 3 * arguments_rounds(&args, PAIRS_A_ROUND); k++)
            set += try_triangle(&r, &where, grid, first, occupied);
        printf("%8u x %6u x %6u: %zu cells set\n", (unsigned)grid->size[0], (unsigned)grid->size[1], (unsigned)grid->size[2], set);
        fflush(stdout);
        assert_true(set > 0);
        free(first);
        free(occupied);
    }
}

PROGRAM(RUN(test_large))
