/* test_arguments_f64.c - bad input of every kind to the calls about meshes of doubles; nothing is written. */
#include <limits.h>
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dispatch.h"
#include "tribox.h"

enum { COUNT = 100, WORDS = 2 };
static const double zeros[9 * COUNT];
static const uint16_t narrow[3 * COUNT];

/* A call's arguments, right until a test spoils one. */
typedef struct call {
    tribox_mesh mesh;
    tribox_box box;
    double origin[3];
    size_t first, count; /* of local streams */
    bool has_mesh, has_box, has_first, has_origin, has_axis[3], has_stream[9];
    tribox_options options;
} call;

/* Valid until the next one. */
static call *right_call(void)
{
    static call c;
    c = (call){.mesh = {.positions = zeros, .vertices = 3 * COUNT, .count = COUNT, .position_bytes = 8},
               .box = {{-1, -1, -1}, {1, 1, 1}},
               .count = COUNT,
               .has_mesh = true,
               .has_box = true,
               .has_first = true,
               .has_origin = true};
    memset(c.has_axis, true, sizeof c.has_axis);
    memset(c.has_stream, true, sizeof c.has_stream);
    return &c;
}

/* All that can be written, poisoned before a call and compared after it. */
typedef struct outputs {
    uint64_t mask[WORDS], inside[WORDS];
    tribox_report report;
    size_t first;
    float stream[9][COUNT];
} outputs;

static outputs poisoned(void)
{
    outputs out;
    memset(&out, 0xa5, sizeof out);
    return out;
}

static const tribox_mesh *mesh_of(const call *c) { return c->has_mesh ? &c->mesh : NULL; }
static const tribox_box *box_of(const call *c) { return c->has_box ? &c->box : NULL; }

typedef tribox_status ask(const call *c, outputs *out);

static tribox_status overlap(const call *c, outputs *out)
{
    return tribox_mesh_overlap(mesh_of(c), box_of(c), &c->options, out->mask, &out->report);
}

static tribox_status any(const call *c, outputs *out)
{
    return tribox_mesh_find(mesh_of(c), box_of(c), &c->options, TRIBOX_FIRST_HIT, c->has_first ? &out->first : NULL);
}

static tribox_status all(const call *c, outputs *out)
{
    return tribox_mesh_find(mesh_of(c), box_of(c), &c->options, TRIBOX_FIRST_MISS, c->has_first ? &out->first : NULL);
}

static tribox_status classify(const call *c, outputs *out)
{
    return tribox_mesh_classify(mesh_of(c), box_of(c), &c->options, out->mask, out->inside, &out->report);
}

static tribox_status streams(const call *c, outputs *out)
{
    float *to[9];
    for (int s = 0; s < 9; s++)
        to[s] = c->has_stream[s] ? out->stream[s] : NULL;
    return tribox_mesh_to_soup(mesh_of(c), c->has_origin ? c->origin : NULL, c->first, c->count, &c->options,
                               c->has_axis[0] ? to : NULL, c->has_axis[1] ? to + 3 : NULL, c->has_axis[2] ? to + 6 : NULL);
}

static ask *const of_boxes[] = {overlap, any, all, classify};
static ask *const of_all[] = {overlap, any, all, classify, streams};

static void expect_one(ask *which, const call *c, tribox_status expected)
{
    outputs out = poisoned();
    const outputs poison = poisoned();
    assert_int_equal(which(c, &out), expected);
    if (expected)
        assert_memory_equal(&out, &poison, sizeof out);
}

#define EXPECT(calls, c, expected) \
    for (size_t which = 0; which < sizeof calls / sizeof calls[0]; which++) \
    expect_one(calls[which], c, expected)

static void test_right_call(void **state)
{
    (void)state;
    static const unsigned bytes[] = {0, 4, 8};
    for (int b = 0; b < 3; b++) {
        call *const c = right_call();
        outputs out = poisoned();
        c->mesh.position_bytes = bytes[b];
        EXPECT(of_all, c, TRIBOX_OK);
        assert_int_equal(overlap(c, &out), TRIBOX_OK);
        assert_int_equal(out.report.overlapping, COUNT);
        assert_int_equal(classify(c, &out), TRIBOX_OK);
        assert_memory_equal(out.mask, out.inside, sizeof out.mask);
        assert_int_equal(any(c, &out), TRIBOX_OK);
        assert_int_equal(out.first, 0);
        assert_int_equal(all(c, &out), TRIBOX_OK);
        assert_int_equal(out.first, COUNT);
        assert_int_equal(tribox_mesh_overlap(&c->mesh, &c->box, NULL, NULL, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_classify(&c->mesh, &c->box, NULL, NULL, NULL, NULL), TRIBOX_OK);
    }
}

static void test_null(void **state)
{
    (void)state;
    call *c = right_call();
    c->has_mesh = false;
    EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->mesh.positions = NULL;
    EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->has_box = false;
    EXPECT(of_boxes, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->has_first = false;
    expect_one(any, c, TRIBOX_BAD_ARGUMENT);
    expect_one(all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->has_origin = false; /* stands for 0 */
    expect_one(streams, c, TRIBOX_OK);
    for (int s = 0; s < 9; s++) {
        c = right_call();
        c->has_stream[s] = false;
        expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
        c = right_call();
        c->has_axis[s / 3] = false;
        expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
    }
}

/* Nothing to do: all that would be read may be NULL, and nothing but the counts is written. */
static void test_count_zero(void **state)
{
    (void)state;
    static const unsigned bytes[] = {0, 4, 8};
    for (int b = 0; b < 3; b++) {
        call *const c = right_call();
        outputs out = poisoned();
        const outputs poison = poisoned();
        c->mesh = (tribox_mesh){.position_bytes = bytes[b]};
        c->count = 0;
        memset(c->has_stream, false, sizeof c->has_stream);
        for (size_t k = 0; k < sizeof of_all / sizeof of_all[0]; k++)
            assert_int_equal(of_all[k](c, &out), TRIBOX_OK);
        assert_int_equal(out.first, 0);
        assert_int_equal(out.report.overlapping, 0);
        assert_int_equal(out.report.undecided, 0);
        assert_memory_equal(out.mask, poison.mask, sizeof out.mask);
        assert_memory_equal(out.inside, poison.inside, sizeof out.inside);
        assert_memory_equal(out.stream, poison.stream, sizeof out.stream);
    }
}

static void test_position_bytes(void **state)
{
    (void)state;
    static const unsigned bad[] = {1, 2, 3, 5, 6, 7, 9, 12, 16, 24, 32, 64, 0x80000008u, UINT_MAX};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        call *const c = right_call();
        c->mesh.position_bytes = bad[k];
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    }
}

static void test_strides(void **state)
{
    (void)state;
    static const unsigned bytes[] = {0, 4, 8};
    for (int b = 0; b < 3; b++) {
        const size_t size = bytes[b] == 8 ? 8 : 4;
        call *c = right_call();
        c->mesh.position_bytes = bytes[b];
        c->mesh.vertices = 3;
        c->mesh.count = c->count = 1;
        for (c->mesh.stride = 1; c->mesh.stride < 3 * size; c->mesh.stride++)
            EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
        EXPECT(of_all, c, TRIBOX_OK);
        c->mesh.axis_stride = 3 * size; /* columns: x of three vertices, then y, then z */
        for (c->mesh.stride = 1; c->mesh.stride < size; c->mesh.stride++)
            EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
        EXPECT(of_all, c, TRIBOX_OK);
        c->mesh.stride = 3 * size;
        for (c->mesh.axis_stride = 1; c->mesh.axis_stride < size; c->mesh.axis_stride++)
            EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    }
}

/* What no address space holds: vertices, axes, triangles. */
static void test_overflow(void **state)
{
    (void)state;
    static const size_t layouts[][3] = {/* vertices, stride, axis stride */
                                        {SIZE_MAX, 0, 0},
                                        {SIZE_MAX / 24 + 2, 24, 0},
                                        {(size_t)PTRDIFF_MAX / 24 + 1, 0, 0},
                                        {3, SIZE_MAX, 0},
                                        {4, SIZE_MAX / 4 + 1, 0},
                                        {300, 24, SIZE_MAX},
                                        {300, 24, SIZE_MAX / 2},
                                        {300, 8, (size_t)PTRDIFF_MAX / 2 + 1},
                                        {300, (size_t)PTRDIFF_MAX / 300, (size_t)PTRDIFF_MAX / 2},
                                        {SIZE_MAX / 8 + 2, 8, 8}};
    for (size_t k = 0; k < sizeof layouts / sizeof layouts[0]; k++) {
        call *const c = right_call();
        c->mesh.vertices = layouts[k][0];
        c->mesh.stride = layouts[k][1];
        c->mesh.axis_stride = layouts[k][2];
        c->mesh.count = c->count = 1;
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    }
    static const size_t counts[] = {SIZE_MAX, SIZE_MAX / 3 + 1, (size_t)PTRDIFF_MAX / 4, SIZE_MAX - 63};
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        call *const c = right_call();
        c->mesh.count = counts[k];
        c->mesh.indices = k % 2 ? narrow : NULL;
        c->mesh.index_bytes = 2;
        EXPECT(of_all, c, k % 2 && counts[k] <= (size_t)PTRDIFF_MAX / 12 ? TRIBOX_BAD_VERTEX : TRIBOX_BAD_ARGUMENT);
    }
}

static void test_ranges(void **state)
{
    (void)state;
    static const size_t ranges[][2] = {{0, COUNT + 1}, {1, COUNT},    {COUNT, 1},        {COUNT + 1, 0},       {COUNT - 1, 2},
                                       {SIZE_MAX, 0},  {SIZE_MAX, 1}, {2, SIZE_MAX - 1}, {SIZE_MAX, SIZE_MAX}, {0, SIZE_MAX}};
    for (size_t k = 0; k < sizeof ranges / sizeof ranges[0]; k++) {
        call *const c = right_call();
        c->first = ranges[k][0];
        c->count = ranges[k][1];
        expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
    }
    call *const c = right_call();
    memset(c->has_stream, false, sizeof c->has_stream);
    c->count = 0;
    for (c->first = 0; c->first <= COUNT; c->first++)
        expect_one(streams, c, TRIBOX_OK);
}

static void test_indices(void **state)
{
    (void)state;
    static const unsigned bad[] = {0, 1, 3, 8, 258, UINT_MAX};
    call *c = right_call();
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        c->mesh.index_bytes = bad[k];
        c->mesh.indices = NULL;
        EXPECT(of_all, c, TRIBOX_OK);
        c->mesh.indices = narrow;
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    }
    c = right_call();
    c->mesh.vertices = 0;
    EXPECT(of_all, c, TRIBOX_BAD_VERTEX);
    c->options.kernel = "nope";
    EXPECT(of_all, c, TRIBOX_NO_KERNEL);
}

static const double not_finite[] = {NAN, -NAN, INFINITY, -INFINITY};

static void test_boxes_and_origins(void **state)
{
    (void)state;
    for (size_t b = 0; b < 4; b++) {
        for (int k = 0; k < 6; k++) {
            call *const c = right_call();
            (k < 3 ? c->box.lo : c->box.hi)[k % 3] = not_finite[b];
            EXPECT(of_boxes, c, TRIBOX_BAD_BOX);
            c->mesh.count = 0;
            EXPECT(of_boxes, c, TRIBOX_BAD_BOX);
        }
        for (int a = 0; a < 3; a++) {
            call *const c = right_call();
            c->origin[a] = not_finite[b];
            expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
        }
    }
}

/* Nothing overlaps it, at any accuracy and on any axes. */
static void test_empty_boxes(void **state)
{
    (void)state;
    for (unsigned axes = 0; axes <= TRIBOX_AXES_ALL; axes++)
        for (int k = 0; k < 9; k++) {
            call *const c = right_call();
            outputs out = poisoned();
            c->options = (tribox_options){.accuracy = (tribox_accuracy)(k / 3), .axes = axes};
            c->box.lo[k % 3] = 1e-300;
            c->box.hi[k % 3] = 0;
            assert_int_equal(classify(c, &out), TRIBOX_OK);
            for (int w = 0; w < WORDS; w++)
                assert_true(out.mask[w] == 0 && out.inside[w] == 0);
            assert_int_equal(out.report.overlapping, 0);
            assert_int_equal(overlap(c, &out), TRIBOX_OK);
            assert_int_equal(out.report.overlapping, 0);
            assert_int_equal(any(c, &out), TRIBOX_OK);
            assert_int_equal(out.first, COUNT);
            assert_int_equal(all(c, &out), TRIBOX_OK);
            assert_int_equal(out.first, 0);
        }
}

static void test_options(void **state)
{
    (void)state;
    static const int accuracies[] = {3, 99, -1, INT_MAX, INT_MIN};
    static const unsigned axes[] = {8, 15, 0x80000000u, UINT_MAX}, orders[] = {1, 12, 111, 124, UINT_MAX};
    call *c = right_call();
    for (size_t k = 0; k < sizeof accuracies / sizeof accuracies[0]; k++) {
        c->options.accuracy = (tribox_accuracy)accuracies[k];
        EXPECT(of_boxes, c, TRIBOX_BAD_OPTION);
        expect_one(streams, c, TRIBOX_OK);
    }
    c = right_call();
    for (size_t k = 0; k < sizeof axes / sizeof axes[0]; k++) {
        c->options.axes = axes[k];
        EXPECT(of_boxes, c, TRIBOX_BAD_OPTION);
        expect_one(streams, c, TRIBOX_OK);
    }
    c = right_call();
    for (size_t k = 0; k < sizeof orders / sizeof orders[0]; k++) {
        c->options.axis_order = orders[k];
        EXPECT(of_boxes, c, TRIBOX_BAD_OPTION);
        expect_one(streams, c, TRIBOX_OK);
    }
    c = right_call();
    for (size_t i = 0; i < tribox_kernel_count(); i++) {
        c->options.kernel = tribox_kernel_at(i)->name;
        EXPECT(of_all, c, tribox_kernel_runs_here(i) ? TRIBOX_OK : TRIBOX_NO_KERNEL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_call),     cmocka_unit_test(test_null),    cmocka_unit_test(test_count_zero),
        cmocka_unit_test(test_position_bytes), cmocka_unit_test(test_strides), cmocka_unit_test(test_overflow),
        cmocka_unit_test(test_ranges),         cmocka_unit_test(test_indices), cmocka_unit_test(test_boxes_and_origins),
        cmocka_unit_test(test_empty_boxes),    cmocka_unit_test(test_options),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
