/*
 * test_grid.c - the planes of a grid are those of C's fma, its cells what lies between them, to the bit; sizes in words saturate;
 * and a grid is served if and only if its planes rise.
 */
#include "cells.h"

#include <float.h>
#include <math.h>

#include "common/harness.h"
#include "kinds.h"

enum { CELLS_MAX = 8000, PAIRS_A_ROUND = 100000 };

static cells_case drawn;

static bool has_bits_of(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

/* To the bit, the sign of a zero too. */
static void assert_boxes_equal(const tribox_box *a, const tribox_box *b)
{
    for (int k = 0; k < 3; k++) {
        assert_true(has_bits_of(a->lo[k], b->lo[k]));
        assert_true(has_bits_of(a->hi[k], b->hi[k]));
    }
}

CASE(test_cells)
{
    random_source r = random_named(args.seed, "cells");
    for (size_t round = 0; round < 30 * grid_kind_count(); round++) {
        draw_grid_of_kind(&r, grid_kind_at(round % grid_kind_count()), CELLS_MAX, &drawn);
        for (int n = 0; n < 200; n++) {
            uint32_t cell[3];
            for (int a = 0; a < 3; a++)
                cell[a] = (uint32_t)random_below(&r, drawn.grid.size[a]);
            const tribox_box box = tribox_grid_cell(&drawn.grid, cell[0], cell[1], cell[2]);
            const tribox_box expected = cells_box(&drawn, cell);
            assert_boxes_equal(&box, &expected);
            for (int a = 0; a < 3; a++) {
                uint32_t next[3] = {cell[0], cell[1], cell[2]};
                if (++next[a] == drawn.grid.size[a])
                    continue;
                const tribox_box neighbour = tribox_grid_cell(&drawn.grid, next[0], next[1], next[2]);
                assert_true(has_bits_of(box.hi[a], neighbour.lo[a]));
            }
        }
    }
}

static tribox_grid grid_of(uint32_t x, uint32_t y, uint32_t z) { return (tribox_grid){{0, 0, 0}, {1, 1, 1}, {x, y, z}}; }

/* Few bits, so that sums are ties; or many. */
static double draw_number(random_source *r, int exponent)
{
    const double number = random_int(r, 2) ? random_double(r, 1, 2) : 1 + random_int(r, 8) / 8.0;
    return ldexp(random_int(r, 2) ? number : -number, exponent);
}

/* Plane p such that the product is near the origin, far from it, or cancels it; or the origin says to which side a tie goes. */
static void draw_plane(random_source *r, double *from, double *cell, uint32_t *p)
{
    const int exponent = random_int_between(r, -1074, 990);
    *p = (uint32_t)(random_bits(r) >> random_int_between(r, 32, 63));
    *cell = fabs(draw_number(r, exponent));
    *from = draw_number(r, exponent + random_int_between(r, -140, 120 - (exponent > 900 ? exponent - 900 : 0)));
    if (!random_int(r, 4))
        *from = -(*cell * *p) * (1 + random_int_between(r, -2, 2) * DBL_EPSILON);
    if (!random_int(r, 50))
        *from = random_int(r, 2) ? 0.0 : -0.0;
}

CASE(test_planes)
{
    random_source r = random_named(args.seed, "planes");
    for (size_t round = 0; round < 300000 * arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        tribox_grid grid = grid_of(UINT32_MAX, 1, 1);
        uint32_t p;
        draw_plane(&r, &grid.origin[0], &grid.cell[0], &p);
        const double lo = plane_of(&grid, 0, p), hi = plane_of(&grid, 0, p + 1.0);
        if (!isfinite(grid.origin[0]) || !isfinite(lo) || !isfinite(hi) || !(grid.cell[0] > 0))
            continue;
        const tribox_box box = tribox_grid_cell(&grid, p, 0, 0);
        if (!has_bits_of(box.lo[0], lo) || !has_bits_of(box.hi[0], hi))
            fail_msg("origin %a, cell %a, cell number %u: %a %a for %a %a", grid.origin[0], grid.cell[0], (unsigned)p, box.lo[0],
                     box.hi[0], lo, hi);
        assert_true(box.lo[1] == 0 && box.hi[2] == 1);
    }
}

CASE(test_words)
{
    static const uint32_t sizes[] = {0, 1, 2, 63, 64, 65, 127, 128, 129, 4096, 65536, UINT32_MAX - 63, UINT32_MAX};
    const size_t count = sizeof sizes / sizeof sizes[0];
    for (size_t x = 0; x < count; x++)
        for (size_t y = 0; y < count; y++)
            for (size_t z = 0; z < count; z++) {
                const uint32_t size[3] = {sizes[x], sizes[y], sizes[z]};
                const size_t row = ((size_t)sizes[x] + 63) / 64;
                size_t words;
                if (__builtin_mul_overflow(row, (size_t)sizes[y], &words) ||
                    __builtin_mul_overflow(words, (size_t)sizes[z], &words))
                    words = SIZE_MAX;
                if (row && sizes[y] && sizes[z])
                    assert_true(tribox_window_words(size) == words);
                else
                    assert_true(tribox_window_words(size) == 0 || tribox_window_words(size) == SIZE_MAX);
            }
}

/* Whether the library serves a grid, soups and meshes alike: told by an empty window. */
static tribox_status status_of(const tribox_grid *grid)
{
    const tribox_soup no_soup = {.count = 0};
    const tribox_mesh no_mesh = {.count = 0};
    static const tribox_window none;
    uint64_t word = 0;
    const tribox_status status = tribox_voxelize(&no_soup, grid, &none, NULL, &word, NULL);
    assert_int_equal(tribox_mesh_voxelize(&no_mesh, grid, &none, NULL, &word, NULL), status);
    return status;
}

/* Cells of about the spacing of doubles, with a power of two among the planes. */
static void draw_fine_axis(random_source *r, tribox_grid *grid, int a)
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

CASE(test_fineness)
{
    random_source r = random_named(args.seed, "fineness");
    size_t refused = 0, served = 0;
    for (size_t round = 0; round < 60000 * arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        const int a = random_int(&r, 3);
        tribox_grid grid = grid_of(1, 1, 1);
        bool is_rising = true;
        draw_fine_axis(&r, &grid, a);
        if (!(grid.cell[a] > 0))
            continue;
        for (uint32_t p = 0; p < grid.size[a] && is_rising; p++)
            is_rising = plane_of(&grid, a, p + 1.0) > plane_of(&grid, a, p);
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

/* As many planes as there can be, told at once; a last plane that is no double, while the one before is; and what is no number. */
CASE(test_ends)
{
#define M UINT32_MAX
    static const double sound[][3] = {{0, 0.1, M},
                                      {0x1p52, 1, M},
                                      {-0x1p53, 1, M},
                                      {-0x1p53 - 2, 2, M},
                                      {0x1p52, 1 - 0x1p-50, M},
                                      {0x1p52, 1 - 0x1p-33, M},
                                      {-0x1p-1042, 0x1p-1074, M},
                                      {0x1p53 - 0x1p31, 2, M},
                                      {0, 0x1p1022, 3},
                                      {-DBL_MAX, DBL_MAX, 2}};
    static const double unsound[][3] = {{0x1p52 - 3.5, 1, M},
                                        {0x1p53 - 0x1p31, 1, M},
                                        {0x1p53 - 9, 1, M},
                                        {-0x1p53 - 2, 1, M},
                                        {0x1p52, 0.9, M},
                                        {0x1p52, 1 - 0x1p-32, M},
                                        {0x1p53 - 0x1p31 + 1, 2, M},
                                        {0, 0, 2},
                                        {0, -0.0, 2},
                                        {0, -1, 2},
                                        {0, -0x1p-1074, 2},
                                        {0, NAN, 2},
                                        {0, INFINITY, 2},
                                        {0, -INFINITY, 2},
                                        {NAN, 1, 2},
                                        {INFINITY, 1, 2},
                                        {-INFINITY, 1, 2},
                                        {0, 1, 0},
                                        {0, 0x1p1022, 4},
                                        {-DBL_MAX, DBL_MAX, 3}};
#undef M
    enum { SOUND = sizeof sound / sizeof sound[0], UNSOUND = sizeof unsound / sizeof unsound[0] };
    for (int k = 0; k < 3 * (SOUND + UNSOUND); k++) {
        const bool is_sound = k / 3 < SOUND;
        const double *const of = is_sound ? sound[k / 3] : unsound[k / 3 - SOUND];
        tribox_grid grid = grid_of(2, 2, 1);
        grid.origin[k % 3] = of[0];
        grid.cell[k % 3] = of[1];
        grid.size[k % 3] = (uint32_t)of[2];
        if (status_of(&grid) != (is_sound ? TRIBOX_OK : TRIBOX_BAD_GRID))
            fail_msg("origin %a, cell %a, size %a", of[0], of[1], of[2]);
    }
}

/* Edges of which products vanish beside those of a cell's length: cells are those that tribox_mesh_overlap tells. */
CASE(test_tiny_parts)
{
    enum { SIDE = 4 };
    random_source r = random_named(args.seed, "tiny parts");
    const tribox_grid grid = {{0, 0, 0}, {0.7, 0.7, 0.7}, {SIDE, SIDE, SIDE}};
    for (int round = 0; round < 3000; round++) {
        uint64_t occupied[SIDE * SIDE] = {0};
        double u[9];
        for (int k = 0; k < 9; k++)
            u[k] = k < 6 || random_int(&r, 3) == 0 ? 0x1p-1072 * (random_int(&r, 19) - 9) : random_int(&r, 15) - 7;
        const tribox_mesh mesh = {.positions = u, .vertices = 3, .count = 1, .position_bytes = sizeof(double)};
        assert_int_equal(tribox_mesh_voxelize(&mesh, &grid, NULL, NULL, occupied, NULL), TRIBOX_OK);
        for (uint32_t c = 0; c < SIDE * SIDE * SIDE; c++) {
            const tribox_box box = tribox_grid_cell(&grid, c % SIDE, c / SIDE % SIDE, c / SIDE / SIDE);
            uint64_t overlaps;
            assert_int_equal(tribox_mesh_overlap(&mesh, &box, NULL, &overlaps, NULL), TRIBOX_OK);
            assert_int_equal(occupied[c / SIDE] >> c % SIDE & 1, overlaps);
        }
    }
}

PROGRAM(RUN(test_cells), RUN(test_planes), RUN(test_words), RUN(test_fineness), RUN(test_ends), RUN(test_tiny_parts))
