/* test_kernels_arguments.c - bad input of every kind is named by its status, and nothing is written. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dispatch.h"

static const float zeros[100];
static const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}};
static const float point[3][3];

/* A call's arguments, right until a test spoils one. */
typedef struct call {
    tribox_soup soup;
    tribox_boxes boxes;
    const tribox_box *box;
    const float (*triangle)[3];
    tribox_options options;
} call;

static call right_call(void)
{
    return (call){.soup = {{zeros, zeros, zeros}, {zeros, zeros, zeros}, {zeros, zeros, zeros}, 100},
                  .boxes = {{zeros, zeros, zeros}, {zeros, zeros, zeros}, 100},
                  .box = &cube,
                  .triangle = point};
}

/* The outputs: poisoned before a call, and compared after it. */
typedef struct outputs {
    uint64_t mask[2];
    tribox_report report;
} outputs;

static const outputs poison = {{UINT64_C(0xa5a5a5a5a5a5a5a5), UINT64_C(0x5a5a5a5a5a5a5a5a)}, {12345, 67890}};

static void assert_soup_status(const call *c, const tribox_soup *soup, tribox_status expected)
{
    outputs out = poison;
    assert_int_equal(tribox_overlap(soup, c->box, &c->options, out.mask, &out.report), expected);
    if (expected)
        assert_memory_equal(&out, &poison, sizeof out);
}

static void assert_boxes_status(const call *c, const tribox_boxes *boxes, tribox_status expected)
{
    outputs out = poison;
    assert_int_equal(tribox_overlap_boxes((const float *)c->triangle, boxes, &c->options, out.mask, &out.report), expected);
    if (expected)
        assert_memory_equal(&out, &poison, sizeof out);
}

static void assert_both_statuses(const call *c, tribox_status expected)
{
    assert_soup_status(c, &c->soup, expected);
    assert_boxes_status(c, &c->boxes, expected);
}

static void test_right_call(void **state)
{
    (void)state;
    const call c = right_call();
    assert_both_statuses(&c, TRIBOX_OK);
    outputs out = poison;
    assert_int_equal(tribox_overlap(&c.soup, c.box, NULL, out.mask, &out.report), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, 100);
    assert_int_equal(tribox_overlap(&c.soup, c.box, NULL, NULL, NULL), TRIBOX_OK);
    out = poison;
    assert_int_equal(tribox_overlap_boxes((const float *)c.triangle, &c.boxes, NULL, out.mask, &out.report), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, 100);
    assert_int_equal(tribox_overlap_boxes((const float *)c.triangle, &c.boxes, NULL, NULL, NULL), TRIBOX_OK);
}

/* Without options the answer is EXACT: a triangle in the plane x + y = 2, which touches an edge of the cube, is settled slowly. */
static void test_null_options(void **state)
{
    (void)state;
    static const float x[3] = {2.25f, -0.25f, 1.25f}, y[3] = {-0.25f, 2.25f, 0.75f}, z[3] = {0.5f, 0.25f, -2};
    const tribox_soup soup = {{x, x + 1, x + 2}, {y, y + 1, y + 2}, {z, z + 1, z + 2}, 1};
    uint64_t mask;
    tribox_report report;
    assert_int_equal(tribox_overlap(&soup, &cube, NULL, &mask, &report), TRIBOX_OK);
    assert_int_equal(report.overlapping, 1);
    assert_int_equal(report.undecided, 1);
}

static void test_null_operands(void **state)
{
    (void)state;
    call c = right_call();
    assert_soup_status(&c, NULL, TRIBOX_BAD_ARGUMENT);
    assert_boxes_status(&c, NULL, TRIBOX_BAD_ARGUMENT);
    c.box = NULL;
    c.triangle = NULL;
    assert_both_statuses(&c, TRIBOX_BAD_ARGUMENT);
}

static void test_null_streams(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        call x = right_call(), y = right_call(), z = right_call(), lo = right_call(), hi = right_call();
        x.soup.x[k] = y.soup.y[k] = z.soup.z[k] = lo.boxes.lo[k] = hi.boxes.hi[k] = NULL;
        assert_soup_status(&x, &x.soup, TRIBOX_BAD_ARGUMENT);
        assert_soup_status(&y, &y.soup, TRIBOX_BAD_ARGUMENT);
        assert_soup_status(&z, &z.soup, TRIBOX_BAD_ARGUMENT);
        assert_boxes_status(&lo, &lo.boxes, TRIBOX_BAD_ARGUMENT);
        assert_boxes_status(&hi, &hi.boxes, TRIBOX_BAD_ARGUMENT);
    }
}

/* No triangles, no boxes: streams may be NULL, and no word of the mask is written. */
static void test_count_zero(void **state)
{
    (void)state;
    const tribox_soup soup = {.count = 0};
    const tribox_boxes boxes = {.count = 0};
    outputs out = poison;
    assert_int_equal(tribox_overlap(&soup, &cube, NULL, out.mask, &out.report), TRIBOX_OK);
    assert_memory_equal(out.mask, poison.mask, sizeof out.mask);
    assert_int_equal(out.report.overlapping, 0);
    out = poison;
    assert_int_equal(tribox_overlap_boxes((const float *)point, &boxes, NULL, out.mask, &out.report), TRIBOX_OK);
    assert_memory_equal(out.mask, poison.mask, sizeof out.mask);
    assert_int_equal(out.report.overlapping, 0);
    assert_int_equal(tribox_overlap(&soup, &cube, NULL, NULL, NULL), TRIBOX_OK);
    assert_int_equal(tribox_overlap_boxes((const float *)point, &boxes, NULL, NULL, NULL), TRIBOX_OK);
}

/* What is wrong besides stays wrong when there is nothing to do. */
static void test_count_zero_is_checked(void **state)
{
    (void)state;
    call c = right_call();
    c.soup.count = c.boxes.count = 0;
    c.options.axes = 8;
    assert_both_statuses(&c, TRIBOX_BAD_OPTION);
    c.options = (tribox_options){.kernel = "nope"};
    assert_both_statuses(&c, TRIBOX_NO_KERNEL);
}

static void test_count_overflows(void **state)
{
    (void)state;
    static const size_t counts[] = {(size_t)PTRDIFF_MAX / sizeof(float) + 1,
                                    SIZE_MAX / sizeof(float),
                                    SIZE_MAX / sizeof(float) + 1,
                                    SIZE_MAX - 63,
                                    SIZE_MAX - 1,
                                    SIZE_MAX};
    call c = right_call();
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        c.soup.count = c.boxes.count = counts[k];
        assert_both_statuses(&c, TRIBOX_BAD_ARGUMENT);
    }
}

static void test_bad_boxes(void **state)
{
    (void)state;
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 6; k++)
        for (size_t b = 0; b < sizeof bad / sizeof bad[0]; b++) {
            call c = right_call();
            tribox_box box = cube;
            (k < 3 ? box.lo : box.hi)[k % 3] = bad[b];
            c.box = &box;
            assert_soup_status(&c, &c.soup, TRIBOX_BAD_BOX);
            c.soup.count = 0;
            assert_soup_status(&c, &c.soup, TRIBOX_BAD_BOX);
        }
}

/* The largest box is finite. An empty box is right, and its options are looked at all the same. */
static void test_unusual_boxes(void **state)
{
    (void)state;
    call c = right_call();
    const tribox_box all = {{-FLT_MAX, -FLT_MAX, -FLT_MAX}, {FLT_MAX, FLT_MAX, FLT_MAX}};
    c.box = &all;
    assert_soup_status(&c, &c.soup, TRIBOX_OK);
    const tribox_box empty = {{0, 1, 0}, {0, 0, 0}};
    c.box = &empty;
    assert_soup_status(&c, &c.soup, TRIBOX_OK);
    c.options.axis_order = 7;
    assert_soup_status(&c, &c.soup, TRIBOX_BAD_OPTION);
}

static void test_accuracies(void **state)
{
    (void)state;
    static const int bad[] = {3, 4, 99, -1, INT_MAX, INT_MIN};
    call c = right_call();
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        c.options.accuracy = (tribox_accuracy)bad[k];
        assert_both_statuses(&c, TRIBOX_BAD_OPTION);
    }
}

static void test_axes(void **state)
{
    (void)state;
    static const unsigned bad[] = {8, 9, 15, 16, 0x80000000u, UINT_MAX};
    call c = right_call();
    for (c.options.axes = 0; c.options.axes <= TRIBOX_AXES_ALL; c.options.axes++)
        assert_both_statuses(&c, TRIBOX_OK);
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        c.options.axes = bad[k];
        assert_both_statuses(&c, TRIBOX_BAD_OPTION);
    }
}

/* Also for axis sets in which the order has little or nothing to say. */
static void test_orders(void **state)
{
    (void)state;
    static const unsigned right[] = {0, 123, 132, 213, 231, 312, 321};
    static const unsigned large[] = {1123, 3210, 123123, 0x80000000u + 123, UINT_MAX};
    call c = right_call();
    for (c.options.axes = 1; c.options.axes <= TRIBOX_AXES_ALL; c.options.axes++) {
        size_t rights = 0;
        for (c.options.axis_order = 0; c.options.axis_order <= 400; c.options.axis_order++) {
            const bool is_right = rights < sizeof right / sizeof right[0] && right[rights] == c.options.axis_order;
            rights += is_right;
            assert_both_statuses(&c, is_right ? TRIBOX_OK : TRIBOX_BAD_OPTION);
        }
        for (size_t k = 0; k < sizeof large / sizeof large[0]; k++) {
            c.options.axis_order = large[k];
            assert_both_statuses(&c, TRIBOX_BAD_OPTION);
        }
    }
}

static void test_kernels(void **state)
{
    (void)state;
    static const char *const bad[] = {"", "AVX2", "nope", "scalar ", "sse", "avx512f"};
    call c = right_call();
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        c.options.kernel = bad[k];
        assert_both_statuses(&c, TRIBOX_NO_KERNEL);
    }
    for (size_t i = 0; i < tribox_kernel_count(); i++) {
        c.options.kernel = tribox_kernel_at(i)->name;
        assert_both_statuses(&c, tribox_kernel_runs_here(i) ? TRIBOX_OK : TRIBOX_NO_KERNEL);
    }
}

/* An error writes nothing and needs no outputs either. */
static void test_errors_without_outputs(void **state)
{
    (void)state;
    const call c = right_call();
    const tribox_options options = {.axes = 8};
    assert_int_equal(tribox_overlap(NULL, &cube, NULL, NULL, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_overlap_boxes(NULL, &c.boxes, NULL, NULL, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_overlap(&c.soup, &cube, &options, NULL, NULL), TRIBOX_BAD_OPTION);
    assert_int_equal(tribox_overlap_boxes((const float *)point, &c.boxes, &options, NULL, NULL), TRIBOX_BAD_OPTION);
}

static void test_mask_words(void **state)
{
    (void)state;
    assert_int_equal(tribox_mask_words(0), 0);
    for (size_t count = 1; count < 1000; count++)
        assert_int_equal(tribox_mask_words(count), (count - 1) / 64 + 1);
    assert_int_equal(tribox_mask_words(SIZE_MAX), SIZE_MAX / 64 + 1);
    assert_int_equal(tribox_mask_words(SIZE_MAX - 63), SIZE_MAX / 64);
    assert_int_equal(tribox_mask_words(SIZE_MAX - 62), SIZE_MAX / 64 + 1);
}

static void test_not_finite_without_streams(void **state)
{
    (void)state;
    size_t first = 1234;
    assert_int_equal(tribox_soup_not_finite(NULL, &first), 0);
    assert_int_equal(first, 0);
    assert_int_equal(tribox_soup_not_finite(NULL, NULL), 0);
    for (int k = 0; k < 9; k++) {
        call c = right_call();
        const float **const streams[3] = {c.soup.x, c.soup.y, c.soup.z};
        streams[k / 3][k % 3] = NULL;
        first = 1234;
        assert_int_equal(tribox_soup_not_finite(&c.soup, &first), 0);
        assert_int_equal(first, 0);
    }
}

static void test_status_texts(void **state)
{
    (void)state;
    for (int s = TRIBOX_OK; s <= TRIBOX_STOPPED; s++) {
        const char *const text = tribox_status_text((tribox_status)s);
        assert_non_null(text);
        assert_true(strlen(text) > 0);
        assert_true(text[strlen(text) - 1] != '.');
        for (int other = TRIBOX_OK; other < s; other++)
            assert_string_not_equal(text, tribox_status_text((tribox_status)other));
    }
    static const int unknown[] = {TRIBOX_STOPPED + 1, 99, -1, INT_MAX, INT_MIN};
    for (size_t k = 0; k < sizeof unknown / sizeof unknown[0]; k++) {
        assert_non_null(tribox_status_text((tribox_status)unknown[k]));
        assert_true(strlen(tribox_status_text((tribox_status)unknown[k])) > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_call),
        cmocka_unit_test(test_null_options),
        cmocka_unit_test(test_null_operands),
        cmocka_unit_test(test_null_streams),
        cmocka_unit_test(test_count_zero),
        cmocka_unit_test(test_count_zero_is_checked),
        cmocka_unit_test(test_count_overflows),
        cmocka_unit_test(test_bad_boxes),
        cmocka_unit_test(test_unusual_boxes),
        cmocka_unit_test(test_accuracies),
        cmocka_unit_test(test_axes),
        cmocka_unit_test(test_orders),
        cmocka_unit_test(test_kernels),
        cmocka_unit_test(test_errors_without_outputs),
        cmocka_unit_test(test_mask_words),
        cmocka_unit_test(test_not_finite_without_streams),
        cmocka_unit_test(test_status_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
