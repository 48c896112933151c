/*
 * test_embree_exact.c - the library against rays, on integers: no tolerance, no dispute, and FAST may not err either.
 * Vertices are integers from 0 to 63, planes lie at multiples of 1, 2 and 4; so shifted by 2^20, and so scaled by 2^-10.
 */
#include <math.h>

#include "common/ask.h"

#include "common/arguments.h"
#include "data_set.h"
#include "embree.h"

enum { SKIPPED = 77, EXTENT = 64, FINEST = 1, COARSEST = 4 };

typedef model maker(random_source *r);

static model anywhere(random_source *r) { return model_soup(r, 600, 2); }
static model within_8(random_source *r) { return model_soup(r, 8000, 2.0 * 8 / 63); }
static model within_2(random_source *r) { return model_soup(r, 8000, 2.0 * 2 / 63); }

static model icosphere(random_source *r)
{
    (void)r;
    return model_icosphere(4);
}

static model torus(random_source *r)
{
    (void)r;
    return model_torus(64, 32, 8.0 / 28);
}

static model cube(random_source *r)
{
    (void)r;
    return model_cube(8);
}

/* Made in [-1, 1]^3, then scaled, shifted and snapped. */
static const struct source {
    const char *name;
    maker *make;
    double scale, shift;
} sources[] = {
    {"soup", anywhere, 31.5, 31.5},
    {"soup within 8", within_8, 31.5, 31.5},
    {"soup within 2", within_2, 31.5, 31.5},
    {"icosphere", icosphere, 28, 32},
    {"torus", torus, 28, 32},
    {"cube", cube, 16, 32},
};

/* Scaled by a power of two, every number of the same pairs rounds alike: one grid is enough there. */
static const struct frame {
    const char *name;
    float scale, shift;
    bool has_all_grids;
} frames[] = {{"", 1, 0, true}, {" + 2^20", 1, 0x1p20f, true}, {" * 2^-10", 0x1p-10f, 0, false}};

static void check_source(const struct source *from, const struct frame *in, const int h[3], uint64_t seed)
{
    char name[64];
    (void)snprintf(name, sizeof name, "%s%s, %d %d %d", from->name, in->name, h[0], h[1], h[2]);
    random_source r = random_named(seed, from->name);
    data_set d = {.name = name, .model = from->make(&r), .is_exact = true};
    model_place(&d.model, (const double[3]){from->scale, from->scale, from->scale},
                (const double[3]){from->shift, from->shift, from->shift});
    model_snap(&d.model);
    model_place(&d.model, (const double[3]){(double)in->scale, (double)in->scale, (double)in->scale},
                (const double[3]){(double)in->shift, (double)in->shift, (double)in->shift});
    for (int a = 0; a < 3; a++) {
        d.grid.origin[a] = in->shift;
        d.grid.cell[a] = (float)h[a] * in->scale;
        d.grid.size[a] = (uint32_t)(EXTENT / h[a]);
    }
    data_set_check(&d, seed);
    model_free(&d.model);
}

static void check_frame(const struct frame *in, const arguments *args)
{
    const int finest = arguments_are_short(args) ? 2 * FINEST : FINEST;
    data_set_print_heading();
    for (size_t k = 0; k < sizeof sources / sizeof sources[0]; k++) {
        for (int h = finest; in->has_all_grids && h <= COARSEST; h *= 2)
            check_source(&sources[k], in, (const int[3]){h, h, h}, args->seed);
        check_source(&sources[k], in, (const int[3]){1, 4, 2}, args->seed);
    }
}

static void test_integers(void **state) { check_frame(&frames[0], *state); }
static void test_shifted(void **state) { check_frame(&frames[1], *state); }
static void test_scaled(void **state) { check_frame(&frames[2], *state); }

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!embree_is_usable())
        return SKIPPED;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_integers, &args),
                                       cmocka_unit_test_prestate(test_shifted, &args),
                                       cmocka_unit_test_prestate(test_scaled, &args)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
