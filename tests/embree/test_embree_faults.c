/*
 * test_embree_faults.c - the test of the test: answers with a fault put in on purpose. On integers the witnesses are the truth, so
 * what they miss and what is unfounded must be counted to the last pair; and the library with a group of axes left out is seen too.
 */
#include <string.h>

#include "common/ask.h"

#include "common/arguments.h"
#include "embree.h"
#include "faulty.h"
#include "contact_margin.h"
#include "zeroed.h"
#include "parity.h"

enum { SKIPPED = 77, CELLS = 32, DATA_SETS = 6 };

/* Planes are integers, and so are vertices of the first four. */
typedef struct data {
    const char *name;
    model model;
    grid_planes planes;
    witness witness;
    uint8_t *sides; /* which cells lie within; NULL if the mesh is not closed */
} data;

typedef struct setting {
    uint64_t seed;
    data data[DATA_SETS];
} setting;

/* The model begins at `lowest` on each axis, unless it is snapped. Others get sides of their own, for want of exact ties. */
static void make_data(data *d, const char *name, model s, double scale, double lowest, bool is_exact)
{
    const tribox_grid grid = {{-1, -1, -1}, {1, 1, 1}, {CELLS + 1, CELLS + 1, CELLS + 1}};
    const double scales[3] = {scale, is_exact ? scale : 0.9 * scale, is_exact ? scale : 0.8 * scale};
    *d = (data){.name = name, .model = s};
    model_place(&d->model, scales, (const double[3]){lowest + scales[0], lowest + scales[1], lowest + scales[2]});
    if (is_exact)
        model_snap(&d->model);
    assert_true(planes_make(&d->planes, &grid));
    d->witness = witness_make(&d->planes, &d->model, is_exact);
}

/* Of a closed mesh. */
static void find_sides(data *d, random_source *r)
{
    d->sides = memory_of(parity_cells(&d->planes), sizeof *d->sides);
    assert_true(parity_cast(&d->planes, &d->model, r, d->sides, NULL));
}

static int make_setting(void **state)
{
    setting *const s = *state;
    random_source r = random_named(s->seed, "faults");
    make_data(&s->data[0], "soup", model_soup(&r, 300, 2), 15, 1, true);
    make_data(&s->data[1], "soup within 4", model_soup(&r, 4000, 4.0 / 15), 15, 1, true);
    make_data(&s->data[2], "icosphere", model_icosphere(3), 14, 2, true);
    make_data(&s->data[3], "cube", model_cube(4), 8, 8, true);
    make_data(&s->data[4], "float soup", model_soup(&r, 2000, 0.5), 15, 1, false);
    make_data(&s->data[5], "cube off planes", model_cube(4), 3.7, 1e-7, false);
    find_sides(&s->data[2], &r);
    find_sides(&s->data[3], &r);
    return 0;
}

static int free_setting(void **state)
{
    setting *const s = *state;
    for (int k = 0; k < DATA_SETS; k++) {
        witness_free(&s->data[k].witness);
        model_free(&s->data[k].model);
        free(s->data[k].sides);
    }
    return 0;
}

static size_t differing(const uint64_t *a, const uint64_t *b, size_t words)
{
    size_t cells = 0;
    for (size_t k = 0; k < 64 * words; k++)
        cells += bit_of(a, k) != bit_of(b, k);
    return cells;
}

static size_t words_of(const data *d) { return tribox_window_words(d->planes.grid.size); }

/* Returns how many pairs were seen to be wrong: on integers all that are. */
static size_t try_fault(const setting *s, const data *d, fault f, const uint64_t *right)
{
    uint64_t *const occupied = memory_of(words_of(d), sizeof *occupied);
    faulty x = faulty_make(f, d->model.count, s->seed);
    answerer *const list[] = {&x.base};
    (void)compare(&d->witness, list, 1, occupied);
    const parity_verdict side = d->sides ? parity_judge(&d->planes, d->sides, occupied) : (parity_verdict){0};
    printf("%-18s %-14s %9zu %9zu %9zu %9zu %9zu %9zu\n", fault_name(f), d->name, x.false_no, x.base.missed, x.false_yes,
           x.base.unfounded, differing(occupied, right, words_of(d)), side.mixed);
    free(occupied);
    /* Where coordinates round, a gap below Embree's own slack at a triangle's border may go unseen. */
    assert_in_range(x.base.missed, d->witness.is_exact ? x.false_no : 0, x.false_no);
    assert_in_range(x.base.unfounded, d->witness.is_exact ? x.false_yes : 0, x.false_yes);
    return x.base.missed + x.base.unfounded;
}

static void test_faults(void **state)
{
    const setting *const s = *state;
    uint64_t *right[DATA_SETS];
    for (int k = 0; k < DATA_SETS; k++) {
        const data *const d = &s->data[k];
        faulty sound = faulty_make(FAULT_NONE, d->model.count, s->seed);
        answerer *const list[] = {&sound.base};
        right[k] = memory_of(words_of(d), sizeof *right[k]);
        (void)compare(&d->witness, list, 1, right[k]);
        assert_int_equal(sound.base.missed + sound.base.unfounded, 0);
        assert_true(sound.base.overlapping > 0);
    }
    printf("%-18s %-14s %9s %9s %9s %9s %9s %9s\n", "fault", "data set", "wrong no", "seen", "wrong yes", "seen", "in voxels",
           "leaks");
    for (int f = FAULT_NONE; f < FAULTS; f++) {
        size_t seen = 0;
        for (int k = 0; k < DATA_SETS; k++)
            seen += try_fault(s, &s->data[k], (fault)f, right[k]);
        assert_true(f == FAULT_NONE ? seen == 0 : seen > 0);
    }
    for (int k = 0; k < DATA_SETS; k++)
        free(right[k]);
}

/* A pair that only one edge axis separates, by a given part of the box. */
static pair_f32 apart_on_edge(float part)
{
    const float far = 2 + part;
    return (pair_f32){{{far, 0, 0}, {0, far, 0}, {far, far, 0.5f}}, {{-1, -1, -1}, {1, 1, 1}}};
}

/* What CONSERVATIVE and FAST are forgiven is near contact, and a box normal is never forgiven. */
static void test_margins(void **state)
{
    (void)state;
    const pair_f32 touching = apart_on_edge(0), near = apart_on_edge(0x1p-21f), far = apart_on_edge(0x1p-10f);
    assert_true(margin_gap(&touching) == 0 && margin_gap(&near) > 0 && margin_gap(&near) < 0x1p-20);
    assert_true(margin_is_conservative(&touching));
    assert_true(margin_is_conservative(&near));
    assert_false(margin_is_conservative(&far));
    pair_f32 beside = touching;
    beside.box.lo[2] = 0.75f;
    assert_false(margin_is_conservative(&beside));
}

/* The library itself with a group of axes left out. */
typedef struct reduced {
    answerer base;
    tribox_options options;
} reduced;

static void reduced_answer(answerer *self, size_t t, const triangle *u, const tribox_boxes *boxes, uint64_t *mask)
{
    (void)t;
    ask_boxes(u->u, boxes, &((reduced *)(void *)self)->options, mask);
}

static void test_axes_left_out(void **state)
{
    const setting *const s = *state;
    const char *kernels[KERNELS_MAX];
    const int kernel_count = kernels_here(kernels);
    for (unsigned axes = 1; axes < TRIBOX_AXES_ALL; axes++)
        for (int kernel = 0; kernel < kernel_count; kernel++) {
            size_t missed = 0, unfounded = 0;
            for (int k = 0; k < DATA_SETS; k++) {
                reduced x = {.base = {.answer = reduced_answer}, .options = {.axes = axes, .kernel = kernels[kernel]}};
                answerer *const list[] = {&x.base};
                (void)compare(&s->data[k].witness, list, 1, NULL);
                missed += x.base.missed;
                unfounded += x.base.unfounded;
            }
            printf("axes %u, kernel %-8s missed %zu, unfounded %zu\n", axes, kernels[kernel], missed, unfounded);
            assert_int_equal(missed, 0);
            assert_true(unfounded > 0);
        }
}

int main(int argc, char **argv)
{
    arguments args = arguments_parse(argc, argv);
    if (!embree_is_usable())
        return SKIPPED;
    static setting s;
    s.seed = args.seed;
    const struct CMUnitTest tests[] = {{.name = "test_faults", .test_func = test_faults, .initial_state = &s},
                                       {.name = "test_axes_left_out", .test_func = test_axes_left_out, .initial_state = &s},
                                       cmocka_unit_test(test_margins)};
    void *state = &s;
    (void)make_setting(&state);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    (void)free_setting(&state);
    return failed;
}
