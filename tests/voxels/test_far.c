/*
 * test_far.c - triangles in grids too large for every cell to be asked about, against the oracle. Small ones in contact with cells
 * that are far from the origin of a long grid: there the roundings of places and planes are all that counts. And large ones in
 * grids of many rows, and of rows as long as float allows: the cells around points inside, on edges and at vertices. EXACT sets the
 * cells that the oracle does, from every kernel, and counts them.
 */
#include "occupancy.h"

#include <math.h>

#include "cell_oracle.h"
#include "common/contact.h"
#include "common/harness.h"
#include "common/window_bits.h"

enum {
    PAIRS_A_ROUND = 5000,
    TRIANGLES = 4000,  /* a round */
    NEAR = 4,          /* cells of the grid on its short axes, and of a triangle on the long one */
    LONGEST = 1 << 20, /* cells on the long axis */
    POINTS = 1000,     /* of a large triangle */
    PAIRS_OF_LARGE = 100000
};

/* Asks for one triangle; returns how many cells are set, with what was set before. */
static size_t ask(origin *where, const tribox_grid *grid, const float u[3][3], int kernel, uint64_t *occupied)
{
    triangle_list c = {.count = 0};
    tribox_report report;
    triangle_list_put(&c, u);
    const tribox_soup soup = triangle_list_soup(&c);
    where->options = (tribox_options){.kernel = names[kernel], .axes = TRIBOX_AXES_ALL};
    assert_int_equal(tribox_voxelize(&soup, grid, NULL, &where->options, occupied, &report), TRIBOX_OK);
    return report.overlapping;
}

/* Those of these cells that are in the grid: each is what the oracle says. Returns how many are set. */
static size_t check_cells(const origin *where, const tribox_grid *grid, const cell_oracle *t, const uint64_t *occupied,
                          const int64_t from[3], const int64_t end[3])
{
    size_t set = 0;
    int64_t at[3];
    for (at[2] = from[2]; at[2] < end[2]; at[2]++)
        for (at[1] = from[1]; at[1] < end[1]; at[1]++)
            for (at[0] = from[0]; at[0] < end[0]; at[0]++) {
                if (at[0] < 0 || at[1] < 0 || at[2] < 0 || at[0] >= grid->size[0] || at[1] >= grid->size[1] ||
                    at[2] >= grid->size[2])
                    continue;
                const tribox_box box = tribox_grid_cell(grid, (uint32_t)at[0], (uint32_t)at[1], (uint32_t)at[2]);
                const bool answer = window_bit(grid->size, occupied, (size_t)at[0], (size_t)at[1], (size_t)at[2]);
                set += answer;
                if (answer == cell_oracle_overlaps(t, &box, TRIBOX_AXES_ALL))
                    continue;
                pair_f32 pair = {.box = box};
                memcpy(pair.u, t->u, sizeof pair.u);
                grid_planes_print(stderr, grid);
                fail_pair(where, &pair, answer);
            }
    return set;
}

static void draw_grid(random_source *r, tribox_grid *grid, int *longer)
{
    static const float cells[] = {1, 0.1f, 0.3f, 0.7f, 1.9999999f, 1.0000001f};
    *longer = random_int(r, 3);
    for (int a = 0; a < 3; a++) {
        grid->size[a] = a == *longer ? LONGEST >> random_int(r, 11) : NEAR;
        grid->cell[a] =
            random_int(r, 2) ? cells[random_int(r, sizeof cells / sizeof cells[0])] : nearest_float(random_double(r, 1, 2));
        grid->origin[a] = a == *longer && random_int(r, 2) ? nearest_float(-0.5 * grid->size[a] * (double)grid->cell[a]) : 0;
    }
}

/*
 * An edge through the corner of cells as seen along an axis, or a plane through it, as near as floats allow. Thin on an axis, its
 * shadow alone counts.
 */
static void draw_in_contact(random_source *r, const tribox_grid *grid, const int corner[3], float u[3][3])
{
    const int thin = random_int(r, 6), is_plane = random_int(r, 3) == 0;
    const double part = random_double(r, 0.1, 0.9), radius = random_int(r, 2) ? 1.9 : 0.6, inside = random_double(r, 0.2, 0.6);
    for (int a = 0; a < 3; a++) {
        const double at = a == thin ? corner[a] + 0.4 : corner[a], width = a == thin ? 0.3 : radius;
        const double from = grid_planes_place(grid, a, at), cell = grid->cell[a];
        const double v = random_double(r, -width, width) * cell, w = random_double(r, -width, width) * cell;
        u[0][a] = nearest_float(from + v);
        if (is_plane) {
            u[1][a] = nearest_float(from + w);
            u[2][a] = nearest_float(from - (part * (u[0][a] - from) + inside * (u[1][a] - from)));
        } else {
            u[1][a] = nearest_float(from - part * (u[0][a] - from));
            u[2][a] = nearest_float(from + w);
        }
    }
}

CASE(test_far)
{
    random_source r = random_named(args.seed, "far");
    origin where = {.scene = "far", .seed = args.seed, .function = "tribox_voxelize"};
    uint64_t *const occupied = occupancy_make((size_t)LONGEST * NEAR * NEAR);
    size_t set = 0;
    for (size_t k = 0; k < TRIANGLES * arguments_rounds(&args, PAIRS_A_ROUND); k++) {
        tribox_grid grid;
        float u[3][3];
        int longer, corner[3];
        int64_t from[3], end[3];
        draw_grid(&r, &grid, &longer);
        for (int a = 0; a < 3; a++) {
            corner[a] = a == longer ? (int)grid.size[a] - random_int_between(&r, 2, NEAR) : random_int_between(&r, 1, NEAR - 1);
            from[a] = corner[a] - NEAR;
            end[a] = corner[a] + NEAR;
        }
        draw_in_contact(&r, &grid, corner, u);
        const cell_oracle t = cell_oracle_make((const_vertices)u);
        for (int kernel = 0; kernel < kernels; kernel++) {
            const size_t count = ask(&where, &grid, (const_vertices)u, kernel, occupied);
            assert_int_equal(count, check_cells(&where, &grid, &t, occupied, from, end));
            set += count;
            for (int64_t z = from[2] > 0 ? from[2] : 0; z < end[2] && z < grid.size[2]; z++)
                for (int64_t y = from[1] > 0 ? from[1] : 0; y < end[1] && y < grid.size[1]; y++)
                    for (int64_t x = from[0] > 0 ? from[0] : 0; x < end[0] && x < grid.size[0]; x++)
                        window_put(grid.size, occupied, (size_t)x, (size_t)y, (size_t)z, false);
        }
    }
    printf("%zu cells set\n", set);
    assert_true(set > 0);
    free(occupied);
}

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

static size_t try_triangle(random_source *r, origin *where, const tribox_grid *grid, uint64_t *first, uint64_t *occupied)
{
    const size_t words = tribox_window_words(grid->size);
    float u[3][3];
    size_t set = 0;
    draw_triangle(r, grid, u);
    for (int kernel = 0; kernel < kernels; kernel++) {
        uint64_t *const words_of = kernel ? occupied : first;
        memset(words_of, 0, words * sizeof *words_of);
        set = ask(where, grid, (const_vertices)u, kernel, words_of);
        assert_int_equal(set, occupancy_count(words_of, words));
        if (kernel && memcmp(first, occupied, words * sizeof *first))
            fail_msg("kernels %s and %s differ", names[0], names[kernel]);
    }
    const cell_oracle t = cell_oracle_make((const_vertices)u);
    for (int k = 0; k < POINTS; k++) {
        double p[3];
        int64_t from[3], end[3];
        draw_point(r, (const_vertices)u, p);
        for (int a = 0; a < 3; a++) {
            const int64_t middle = (int64_t)floor((p[a] - grid->origin[a]) / grid->cell[a]);
            from[a] = middle - (a ? 1 : 2);
            end[a] = middle + (a ? 2 : 3);
        }
        check_cells(where, grid, &t, first, from, end);
    }
    return set;
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
        for (size_t k = 0; k < 3 * arguments_rounds(&args, PAIRS_OF_LARGE); k++)
            set += try_triangle(&r, &where, grid, first, occupied);
        printf("%8u x %6u x %6u: %zu cells set\n", (unsigned)grid->size[0], (unsigned)grid->size[1], (unsigned)grid->size[2], set);
        fflush(stdout);
        assert_true(set > 0);
        free(first);
        free(occupied);
    }
}

PROGRAM(RUN(test_far), RUN(test_large))
