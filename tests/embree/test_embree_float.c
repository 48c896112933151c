/*
 * test_embree_float.c - the library against rays, on coordinates that round: a breach goes to the exact oracle, CONSERVATIVE and
 * FAST have their bounds. Cells need not be cubes, and planes need not be where origin + p * cell is.
 */
#include "common/ask.h"

#include "common/arguments.h"
#include "data_set.h"
#include "embree.h"

enum { SKIPPED = 77 };

typedef model maker(random_source *r);

static model anywhere(random_source *r) { return model_soup(r, 600, 2); }
static model many_anywhere(random_source *r) { return model_soup(r, 6000, 2); }
static model small(random_source *r) { return model_soup(r, 8000, 0.1); }

static model icosphere(random_source *r)
{
    (void)r;
    return model_icosphere(4);
}

static model torus(random_source *r)
{
    (void)r;
    return model_torus(64, 32, 2.0 / 7);
}

static model cube(random_source *r)
{
    (void)r;
    return model_cube(8);
}

/* All but touching, everywhere: snapped to integers, then moved by an ulp. */
static model shaken(random_source *r)
{
    model s = model_icosphere(4);
    model_place(&s, (const double[3]){28, 28, 28}, (const double[3]){32, 32, 32});
    model_snap(&s);
    model_shake(&s, r);
    return s;
}

/* Made in [-1, 1]^3, then scaled and shifted. */
typedef struct source {
    const char *name;
    maker *make;
    double scale[3], shift[3];
    tribox_grid grid;
} source;

#define CUBES(least, most, n) \
    { \
        {least, least, least}, {(most - (least)) / n, (most - (least)) / n, (most - (least)) / n}, { n, n, n } \
    }
#define AS_IT_IS \
    {1, 1, 1}, { 0, 0, 0 }

static const source cubes[] = {
    {"icosphere 16", icosphere, AS_IT_IS, CUBES(-1.5, 1.5, 16)},
    {"icosphere 64", icosphere, AS_IT_IS, CUBES(-1.5, 1.5, 64)},
    {"icosphere 128", icosphere, AS_IT_IS, CUBES(-1.5, 1.5, 128)},
    {"icosphere, tight", icosphere, AS_IT_IS, CUBES(-1.0, 1.0, 64)},
    {"icosphere, odd cells", icosphere, AS_IT_IS, CUBES(-1.09375, 1.09375, 64)},
    {"torus 16", torus, AS_IT_IS, CUBES(-1.5, 1.5, 16)},
    {"torus 64", torus, AS_IT_IS, CUBES(-1.5, 1.5, 64)},
    {"torus 128", torus, AS_IT_IS, CUBES(-1.5, 1.5, 128)},
    {"torus, tight", torus, AS_IT_IS, CUBES(-1.0, 1.0, 64)},
    {"torus, odd cells", torus, AS_IT_IS, CUBES(-1.09375, 1.09375, 64)},
    {"cube on planes", cube, AS_IT_IS, CUBES(-2.0, 2.0, 64)},
    {"cube, odd cells", cube, AS_IT_IS, CUBES(-1.09375, 1.09375, 64)},
    {"soup 16", many_anywhere, {2, 2, 2}, {0, 0, 0}, CUBES(-2.0, 2.0, 16)},
    {"soup 64", anywhere, {2, 2, 2}, {0, 0, 0}, CUBES(-2.0, 2.0, 64)},
    {"small soup", small, {2, 2, 2}, {0, 0, 0}, CUBES(-2.0, 2.0, 64)},
};

/* Flat and long cells, far ones, and meshes that stick out of the grid. Embree takes floats: so are all planes. */
static const source others[] = {
    {"flat cells", icosphere, AS_IT_IS, {{-1.125, -1.25, -1.3125}, {0.009765625, 0.1015625, 0.703125}, {128, 24, 4}}},
    {"long cells", torus, AS_IT_IS, {{-1.3125, -1.015625, -0.3125}, {0.90625, 0.0166015625, 0.03125}, {3, 120, 20}}},
    {"grid within the mesh",
     icosphere,
     AS_IT_IS,
     {{-0.71875, -0.296875, 0.09375}, {0.0126953125, 0.0205078125, 0.0166015625}, {70, 40, 60}}},
    {"soup in flat cells",
     many_anywhere,
     {2, 3, 1},
     {0, 0, 0},
     {{-1.90625, -2.703125, -0.90625}, {0.296875, 0.109375, 0.90625}, {13, 50, 2}}},
    {"icosphere, far",
     icosphere,
     {1, 1, 1},
     {1000.1, -2000.3, 3000.7},
     {{999, -2001.5, 2999.625}, {0.05078125, 0.041015625, 0.0341796875}, {48, 70, 64}}},
    {"torus, far",
     torus,
     {1, 2, 3},
     {-70000.3, 5, 0.1},
     {{-70001.375, 2.90625, -0.90625}, {0.0703125, 0.05078125, 0.029296875}, {32, 90, 64}}},
    {"small soup, far",
     small,
     {2, 2, 2},
     {100.3, 300.1, -900.7},
     {{98.203125, 298.109375, -902.796875}, {0.060546875, 0.0703125, 0.1015625}, {68, 57, 40}}},
    {"shaken icosphere", shaken, AS_IT_IS, {{0, 0, 0}, {1, 1, 1}, {64, 64, 64}}},
    {"shaken, flat cells", shaken, AS_IT_IS, {{0, 0, 0}, {2, 1, 4}, {32, 64, 16}}},
    {"cube, far",
     cube,
     {1, 1, 1},
     {30000.1, 40000.2, -50000.3},
     {{29999, 39999, -50001.5}, {0.03125, 0.0625, 0.05078125}, {70, 36, 50}}},
};

static void check_source(const source *from, uint64_t seed)
{
    random_source r = random_named(seed, from->name);
    data_set d = {.name = from->name, .model = from->make(&r), .grid = from->grid};
    model_place(&d.model, from->scale, from->shift);
    data_set_check(&d, seed);
    model_free(&d.model);
}

static void test_cubic_cells(void **state)
{
    data_set_print_heading();
    for (size_t k = 0; k < sizeof cubes / sizeof cubes[0]; k++)
        check_source(&cubes[k], *(const uint64_t *)*state);
}

static void test_other_cells(void **state)
{
    data_set_print_heading();
    for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
        check_source(&others[k], *(const uint64_t *)*state);
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!embree_is_usable())
        return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_cubic_cells, &args.seed),
                                       cmocka_unit_test_prestate(test_other_cells, &args.seed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
