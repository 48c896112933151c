/*
 * test_far.c - triangles in grids too large for every cell to be asked about, against the oracle. Small ones in contact with cells
 * that are far from the origin of a long grid: there the roundings of places and planes are all that counts. And large ones in
 * grids of many rows, and of rows as long as float allows: the cells around points inside, on edges and at vertices. EXACT sets the
 * cells that the oracle does, from every kernel, and counts them.
 */
#include "cells.h"

#include <math.h>

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

static cells_case drawn; /* one triangle */

/* Asks in the whole grid; returns how many cells are set, with what was set before. */
static size_t ask(int kernel, uint64_t *occupied)
{
    const soup_or_mesh of = cells_all(&drawn);
    tribox_report report;
    drawn.options = (tribox_options){.kernel = names[kernel], .axes = TRIBOX_AXES_ALL};
    assert_int_equal(tribox_voxelize(&of.soup, &drawn.grid, NULL, &drawn.options, occupied, &report), TRIBOX_OK);
    return report.overlapping;
}

/* Those of the cells from .. end - 1 that are in the grid: each is what the oracle says. Returns how many are set. */
static size_t check_cells(const uint64_t *whole, const int64_t from[3], const int64_t end[3])
{
    uint64_t expected[8 * NEAR * NEAR], occupied[8 * NEAR * NEAR];
    for (int a = 0; a < 3; a++) {
        const int64_t size = drawn.grid.size[a], first = from[a] < 0 ? 0 : from[a], last = end[a] < size ? end[a] : size;
        drawn.at.first[a] = (uint32_t)first;
        drawn.at.size[a] = last > first ? (uint32_t)(last - first) : 0;
        if (last <= first)
            return 0;
    }
    assert_true(cells_words(&drawn) <= sizeof expected / sizeof expected[0]);
    cells_cut(&drawn, whole, occupied);
    cells_expect(&drawn, 0, 1, TRIBOX_AXES_ALL, expected);
    cells_check(&drawn, 0, 1, expected, occupied);
    return cells_count(occupied, cells_words(&drawn));
}

static void draw_grid(random_source *r, int *longer)
{
    tribox_grid *const grid = &drawn.grid;
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
static void draw_in_contact(random_source *r, const int corner[3], double u[3][3])
{
    const tribox_grid *const grid = &drawn.grid;
    const int thin = random_int(r, 6), is_plane = random_int(r, 3) == 0;
    const double part = random_double(r, 0.1, 0.9), radius = random_int(r, 2) ? 1.9 : 0.6, inside = random_double(r, 0.2, 0.6);
    for (int a = 0; a < 3; a++) {
        const double at = a == thin ? corner[a] + 0.4 : corner[a], width = a == thin ? 0.3 : radius;
        const double from = cells_place(&drawn, a, at), cell = grid->cell[a];
        const double v = random_double(r, -width, width) * cell, w = random_double(r, -width, width) * cell;
        u[0][a] = (double)nearest_float(from + v);
        if (is_plane) {
            u[1][a] = (double)nearest_float(from + w);
            u[2][a] = (double)nearest_float(from - (part * (u[0][a] - from) + inside * (u[1][a] - from)));
        } else {
            u[1][a] = (double)nearest_float(from - part * (u[0][a] - from));
            u[2][a] = (double)nearest_float(from + w);
        }
    }
}

CASE(test_far)
{
    random_source r = random_named(args.seed, "far");
    uint64_t *const occupied = cells_make((size_t)LONGEST * NEAR * NEAR);
    size_t set = 0;
    drawn.scene = "far";
    for (size_t k = 0; k < TRIANGLES * arguments_rounds(&args, PAIRS_A_ROUND); k++) {
        double u[3][3];
        int longer, corner[3];
        int64_t from[3], end[3];
        draw_grid(&r, &longer);
        for (int a = 0; a < 3; a++) {
            corner[a] =
                a == longer ? (int)drawn.grid.size[a] - random_int_between(&r, 2, NEAR) : random_int_between(&r, 1, NEAR - 1);
            from[a] = corner[a] - NEAR;
            end[a] = corner[a] + NEAR;
        }
        draw_in_contact(&r, corner, u);
        drawn.count = 0;
        cells_put(&drawn, u);
        for (int kernel = 0; kernel < kernels; kernel++) {
            const uint32_t *const first = drawn.at.first, *const size = drawn.at.size;
            const size_t count = ask(kernel, occupied);
            assert_int_equal(count, check_cells(occupied, from, end));
            set += count;
            for (uint32_t n = 0; n < size[0] * size[1] * size[2]; n++)
                window_put(drawn.grid.size, occupied, first[0] + n % size[0], first[1] + n / size[0] % size[1],
                           first[2] + n / size[0] / size[1], false);
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
static void draw_triangle(random_source *r, double u[3][3])
{
    const double shrink[3] = {random_int(r, 2) ? 1 : 0.01, random_int(r, 2) ? 1 : 0.01, random_int(r, 2) ? 1 : 0.01};
    const bool is_whole = random_int(r, 3) == 0;
    double base[3];
    for (int a = 0; a < 3; a++)
        base[a] = random_double(r, 0, 1 - shrink[a] / 2);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) {
            const double at = drawn.grid.size[a] * (base[a] + shrink[a] * random_double(r, -0.2, 1.2));
            u[j][a] = cells_place(&drawn, a, is_whole ? floor(at) : at);
        }
}

/* One weight or two are often zero. */
static void draw_point(random_source *r, double u[3][3], double p[3])
{
    double weight[3], sum = 0;
    for (int j = 0; j < 3; j++)
        sum += weight[j] = random_int(r, 3) ? random_double(r, 0, 1) : 0;
    if (sum <= 0)
        sum = weight[0] = 1;
    for (int a = 0; a < 3; a++)
        p[a] = (weight[0] * u[0][a] + weight[1] * u[1][a] + weight[2] * u[2][a]) / sum;
}

static size_t try_triangle(random_source *r, uint64_t *first, uint64_t *occupied)
{
    const size_t words = tribox_window_words(drawn.grid.size);
    double u[3][3];
    size_t set = 0;
    draw_triangle(r, u);
    drawn.count = 0;
    cells_put(&drawn, u);
    for (int kernel = 0; kernel < kernels; kernel++) {
        uint64_t *const words_of = kernel ? occupied : first;
        memset(words_of, 0, words * sizeof *words_of);
        set = ask(kernel, words_of);
        assert_int_equal(set, cells_count(words_of, words));
        if (kernel && memcmp(first, occupied, words * sizeof *first))
            fail_msg("kernels %s and %s differ", names[0], names[kernel]);
    }
    const soup_or_mesh of = cells_all(&drawn);
    memset(occupied, 0, words * sizeof *occupied); /* and without a report */
    assert_int_equal(tribox_voxelize(&of.soup, &drawn.grid, NULL, &drawn.options, occupied, NULL), TRIBOX_OK);
    assert_memory_equal(first, occupied, words * sizeof *first);
    for (int k = 0; k < POINTS; k++) {
        double p[3];
        int64_t from[3], end[3];
        draw_point(r, u, p);
        for (int a = 0; a < 3; a++) {
            const int64_t middle = (int64_t)floor((p[a] - drawn.grid.origin[a]) / drawn.grid.cell[a]);
            from[a] = middle - (a ? 1 : 2);
            end[a] = middle + (a ? 2 : 3);
        }
        check_cells(first, from, end);
    }
    return set;
}

CASE(test_large)
{
    drawn.scene = "large";
    for (size_t g = 0; g < sizeof grids / sizeof grids[0]; g++) {
        const uint32_t *const size = grids[g].size;
        random_source r = random_named(args.seed + g, "large");
        uint64_t *const first = cells_make(tribox_window_words(size)), *const occupied = cells_make(tribox_window_words(size));
        size_t set = 0;
        drawn.grid = grids[g];
        for (size_t k = 0; k < 3 * arguments_rounds(&args, PAIRS_OF_LARGE); k++)
            set += try_triangle(&r, first, occupied);
        printf("%8u x %6u x %6u: %zu cells set\n", (unsigned)size[0], (unsigned)size[1], (unsigned)size[2], set);
        fflush(stdout);
        assert_true(set > 0);
        free(first);
        free(occupied);
    }
}

PROGRAM(RUN(test_far), RUN(test_large))
