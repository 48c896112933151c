/*
 * test_far.c - small triangles in contact with cells that are far from the origin of a long grid: there the roundings of places and
 * planes are all that counts. EXACT sets the cells that the oracle does, from every kernel, and counts them.
 */
#include "occupancy.h"

#include <math.h>

#include "cell_oracle.h"
#include "common/harness.h"
#include "common/contact.h"

enum {
    PAIRS_A_ROUND = 5000,
    TRIANGLES = 4000, /* a round */
    NEAR = 4,         /* cells of the grid on its short axes, and of a triangle on the long one */
    LONGEST = 1 << 20 /* cells on the long axis */
};

/* Cells of NEAR on each axis, about those that a triangle touches. */
typedef struct neighbourhood {
    int first[3], end[3];
} neighbourhood;

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
static void draw_triangle(random_source *r, const tribox_grid *grid, const int corner[3], float u[3][3])
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

static neighbourhood neighbourhood_of(const tribox_grid *grid, const int corner[3])
{
    neighbourhood n;
    for (int a = 0; a < 3; a++) {
        n.first[a] = corner[a] > NEAR ? corner[a] - NEAR : 0;
        n.end[a] = corner[a] + NEAR < (int)grid->size[a] ? corner[a] + NEAR : (int)grid->size[a];
    }
    return n;
}

static bool is_set(const tribox_grid *grid, const uint64_t *occupied, int i, int j, int k)
{
    return occupied[((size_t)k * grid->size[1] + (size_t)j) * tribox_mask_words(grid->size[0]) + (size_t)i / 64] >> i % 64 & 1;
}

/* Returns how many cells are set, and clears them. */
static size_t check_cells(const origin *where, const tribox_grid *grid, const neighbourhood *n, const float u[3][3],
                          uint64_t *occupied)
{
    const cell_oracle t = cell_oracle_make(u);
    size_t set = 0;
    for (int k = n->first[2]; k < n->end[2]; k++)
        for (int j = n->first[1]; j < n->end[1]; j++)
            for (int i = n->first[0]; i < n->end[0]; i++) {
                const tribox_box box = tribox_grid_cell(grid, (uint32_t)i, (uint32_t)j, (uint32_t)k);
                const bool answer = is_set(grid, occupied, i, j, k);
                set += answer;
                if (answer == cell_oracle_overlaps(&t, &box, TRIBOX_AXES_ALL))
                    continue;
                pair_f32 pair = {.box = box};
                memcpy(pair.u, u, sizeof pair.u);
                grid_planes_print(stderr, grid);
                fail_pair(where, &pair, answer);
            }
    for (int k = n->first[2]; k < n->end[2]; k++)
        for (int j = n->first[1]; j < n->end[1]; j++)
            for (int i = n->first[0]; i < n->end[0]; i++)
                occupied[((size_t)k * grid->size[1] + (size_t)j) * tribox_mask_words(grid->size[0]) + (size_t)i / 64] = 0;
    return set;
}

CASE(test_far)
{
    random_source r = random_named(args.seed, "far");
    origin where = {.scene = "far", .seed = args.seed, .function = "tribox_voxelize"};
    uint64_t *const occupied = occupancy_make((size_t)LONGEST * NEAR * NEAR);
    size_t set = 0;
    for (size_t k = 0; k < TRIANGLES * arguments_rounds(&args, PAIRS_A_ROUND); k++) {
        tribox_grid grid;
        triangle_list c = {.count = 0};
        float u[3][3];
        int longer, corner[3];
        draw_grid(&r, &grid, &longer);
        for (int a = 0; a < 3; a++)
            corner[a] = a == longer ? (int)grid.size[a] - random_int_between(&r, 2, NEAR) : random_int_between(&r, 1, NEAR - 1);
        draw_triangle(&r, &grid, corner, u);
        triangle_list_put(&c, (const_vertices)u);
        const tribox_soup soup = triangle_list_soup(&c);
        const neighbourhood n = neighbourhood_of(&grid, corner);
        for (int kernel = 0; kernel < kernels; kernel++) {
            tribox_report report;
            where.options = (tribox_options){.kernel = names[kernel], .axes = TRIBOX_AXES_ALL};
            assert_int_equal(tribox_voxelize(&soup, &grid, NULL, &where.options, occupied, &report), TRIBOX_OK);
            assert_int_equal(report.overlapping, check_cells(&where, &grid, &n, (const_vertices)u, occupied));
            set += report.overlapping;
        }
    }
    printf("%zu cells set\n", set);
    assert_true(set > 0);
    free(occupied);
}

PROGRAM(RUN(test_far))
