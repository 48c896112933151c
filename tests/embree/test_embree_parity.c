/*
 * test_embree_parity.c - voxels of closed meshes keep inside and outside apart, even for neighbours by a corner; and a single cell
 * that is missing is seen to leak.
 */
#include "common/ask.h"

#include "common/arguments.h"
#include "embree.h"
#include "zeroed.h"
#include "parity.h"

/* A cell that the surface only grazes has one side around it: its absence is not a leak. */
enum { SKIPPED = 77, REMOVED = 64, LEAKS_LEAST = 56 };

typedef struct mesh {
    const char *name;
    model model;
    grid_planes planes;
    uint64_t *occupied;
    size_t words;
    uint8_t *sides;
    size_t recasts;
} mesh;

/* About the origin in a grid from -1.5 to 1.5; a snapped one on integers, in a grid of unit cells. */
static mesh make_mesh(const char *name, model s, int cells, bool is_snapped, uint64_t seed)
{
    mesh m = {.name = name, .model = s};
    const float edge = is_snapped ? 1 : 3.0f / (float)cells;
    tribox_grid grid;
    if (is_snapped) {
        const double radius = cells * 0.4375;
        model_place(&m.model, (const double[3]){radius, radius, radius}, (const double[3]){0, 0, 0});
        model_snap(&m.model);
    }
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = -edge * (float)cells / 2;
        grid.cell[a] = edge;
        grid.size[a] = (uint32_t)cells;
    }
    assert_true(planes_make(&m.planes, &grid));
    m.words = tribox_window_words(grid.size);
    m.occupied = memory_of(m.words, sizeof *m.occupied);
    m.sides = memory_of(parity_cells(&m.planes), sizeof *m.sides);
    random_source r = random_named(seed, name);
    assert_true(parity_cast(&m.planes, &m.model, &r, m.sides, &m.recasts));
    return m;
}

static void free_mesh(mesh *m)
{
    model_free(&m->model);
    free(m->occupied);
    free(m->sides);
}

static void voxelize(mesh *m, const char *kernel)
{
    const tribox_options options = {.kernel = kernel};
    streams s = streams_make(&m->model);
    for (size_t k = 0; k < m->words; k++)
        m->occupied[k] = 0;
    assert_int_equal(tribox_voxelize(&s.soup, &m->planes.grid, NULL, &options, m->occupied, NULL), TRIBOX_OK);
    streams_free(&s);
}

static void check_mesh(mesh m)
{
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    for (int kernel = 0; kernel < kernel_count; kernel++) {
        voxelize(&m, kernels[kernel]);
        const parity_verdict v = parity_judge(&m.planes, m.sides, m.occupied);
        printf("%-22s %4d cells, %-8s %zu disagree, %zu components, %zu mixed, %zu inside at the border, %zu lines cast again\n",
               m.name, (int)m.planes.grid.size[0], kernels[kernel], v.disagreements, v.components, v.mixed, v.border_inside,
               m.recasts);
        assert_int_equal(v.disagreements + v.mixed + v.border_inside, 0);
        assert_int_equal(v.components, 2);
    }
    free_mesh(&m);
}

static void test_closed_meshes(void **state)
{
    const uint64_t seed = *(const uint64_t *)*state;
    for (int cells = 16; cells <= 128; cells *= cells == 16 ? 4 : 2) {
        check_mesh(make_mesh("icosphere", model_icosphere(4), cells, false, seed));
        check_mesh(make_mesh("torus", model_torus(64, 32, 2.0 / 7), cells, false, seed));
        check_mesh(make_mesh("cube", model_cube(8), cells, false, seed));
        check_mesh(make_mesh("snapped icosphere", model_icosphere(4), cells, true, seed));
    }
    check_mesh(make_mesh("snapped torus", model_torus(64, 32, 2.0 / 7), 64, true, seed));
}

/* The voxels of a mesh, one of them drawn and taken away: is it missed? */
static size_t count_leaks(mesh m, uint64_t seed)
{
    random_source r = random_named(seed, "removed");
    size_t leaks = 0;
    voxelize(&m, NULL);
    for (int k = 0; k < REMOVED; k++) {
        size_t bit;
        do
            bit = (size_t)(random_bits(&r) % (64 * m.words));
        while (!bit_of(m.occupied, bit));
        m.occupied[bit / 64] ^= UINT64_C(1) << bit % 64;
        leaks += parity_judge(&m.planes, m.sides, m.occupied).mixed > 0;
        m.occupied[bit / 64] ^= UINT64_C(1) << bit % 64;
    }
    printf("%-22s %zu of %d cells taken away are seen\n", m.name, leaks, REMOVED);
    free_mesh(&m);
    return leaks;
}

static void test_missing_cell(void **state)
{
    const uint64_t seed = *(const uint64_t *)*state;
    assert_in_range(count_leaks(make_mesh("icosphere", model_icosphere(4), 24, false, seed), seed), LEAKS_LEAST, REMOVED);
    assert_in_range(count_leaks(make_mesh("torus", model_torus(64, 32, 2.0 / 7), 24, false, seed), seed), LEAKS_LEAST, REMOVED);
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!embree_is_usable())
        return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_closed_meshes, &args.seed),
                                       cmocka_unit_test_prestate(test_missing_cell, &args.seed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
