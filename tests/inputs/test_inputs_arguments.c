/*
 * test_inputs_arguments.c - bad input of every kind to calls about meshes, any and all, inside, oriented boxes; nothing is written.
 */
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dispatch.h"
#include "tribox.h"

enum { COUNT = 100, WORDS = 2 };
static const float zeros[9 * COUNT];
static const uint16_t narrow[3 * COUNT];
static const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}};
static const tribox_oriented_box turned = {{0, 0, 0}, {1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/* A call's arguments, right until a test spoils one. */
typedef struct call {
    tribox_soup soup;
    const tribox_soup *soup_or_null;
    tribox_mesh mesh;
    const tribox_mesh *mesh_or_null;
    size_t first, count; /* of mesh_to_streams */
    bool has_stream[9], has_axis[3];
    tribox_box box;
    const tribox_box *box_or_null;
    tribox_oriented_box oriented;
    const tribox_oriented_box *oriented_or_null;
    bool has_first;
    tribox_options options;
} call;

/* Valid until the next one. */
static call *right_call(void)
{
    static call c;
    c = (call){.soup = {{zeros, zeros, zeros}, {zeros, zeros, zeros}, {zeros, zeros, zeros}, COUNT},
               .mesh = {.positions = zeros, .vertices = 3 * COUNT, .count = COUNT},
               .count = COUNT,
               .box = cube,
               .oriented = turned,
               .has_first = true};
    c.soup_or_null = &c.soup;
    c.mesh_or_null = &c.mesh;
    c.box_or_null = &c.box;
    c.oriented_or_null = &c.oriented;
    memset(c.has_stream, true, sizeof c.has_stream);
    memset(c.has_axis, true, sizeof c.has_axis);
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

typedef tribox_status ask(const call *c, outputs *out);

static tribox_status indexed(const call *c, outputs *out)
{
    return tribox_mesh_overlap(c->mesh_or_null, c->box_or_null, &c->options, out->mask, &out->report);
}

static tribox_status streams(const call *c, outputs *out)
{
    float *to[9];
    for (int s = 0; s < 9; s++)
        to[s] = c->has_stream[s] ? out->stream[s] : NULL;
    return tribox_mesh_to_soup(c->mesh_or_null, NULL, c->first, c->count, &c->options, c->has_axis[0] ? to : NULL,
                               c->has_axis[1] ? to + 3 : NULL, c->has_axis[2] ? to + 6 : NULL);
}

static tribox_status any(const call *c, outputs *out)
{
    return tribox_find(c->soup_or_null, c->box_or_null, &c->options, TRIBOX_FIRST_HIT, c->has_first ? &out->first : NULL);
}

static tribox_status all(const call *c, outputs *out)
{
    return tribox_find(c->soup_or_null, c->box_or_null, &c->options, TRIBOX_FIRST_MISS, c->has_first ? &out->first : NULL);
}

static tribox_status classify(const call *c, outputs *out)
{
    return tribox_classify(c->soup_or_null, c->box_or_null, &c->options, out->mask, out->inside, &out->report);
}

static tribox_status oriented(const call *c, outputs *out)
{
    return tribox_overlap_oriented(c->soup_or_null, c->oriented_or_null, &c->options, out->mask, &out->report);
}

static tribox_status mesh_oriented(const call *c, outputs *out)
{
    return tribox_mesh_overlap_oriented(c->mesh_or_null, c->oriented_or_null, &c->options, out->mask, &out->report);
}

static ask *const of_soups[] = {any, all, classify, oriented};
static ask *const of_meshes[] = {indexed, streams, mesh_oriented};
static ask *const of_boxes[] = {any, all, classify, indexed};
static ask *const of_axes[] = {any, all, classify, oriented, indexed, mesh_oriented};
static ask *const of_all[] = {any, all, classify, oriented, indexed, streams, mesh_oriented};

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
    EXPECT(of_all, right_call(), TRIBOX_OK);
    call *const c = right_call();
    outputs out = poisoned();
    assert_int_equal(indexed(c, &out), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, COUNT);
    assert_int_equal(oriented(c, &out), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, COUNT);
    assert_int_equal(mesh_oriented(c, &out), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, COUNT);
    assert_int_equal(any(c, &out), TRIBOX_OK);
    assert_int_equal(out.first, 0);
    assert_int_equal(all(c, &out), TRIBOX_OK);
    assert_int_equal(out.first, COUNT);
    assert_int_equal(classify(c, &out), TRIBOX_OK);
    assert_memory_equal(out.mask, out.inside, sizeof out.mask);
}

/* Options may be NULL, and so may what is not wanted. */
static void test_absent_outputs(void **state)
{
    (void)state;
    const call *const c = right_call();
    outputs out = poisoned();
    assert_int_equal(tribox_mesh_overlap(&c->mesh, &cube, NULL, out.mask, &out.report), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, COUNT);
    assert_int_equal(tribox_mesh_overlap(&c->mesh, &cube, NULL, NULL, NULL), TRIBOX_OK);
    assert_int_equal(tribox_overlap_oriented(&c->soup, &turned, NULL, out.mask, &out.report), TRIBOX_OK);
    assert_int_equal(out.report.overlapping, COUNT);
    assert_int_equal(tribox_overlap_oriented(&c->soup, &turned, NULL, NULL, NULL), TRIBOX_OK);
    assert_int_equal(tribox_mesh_overlap_oriented(&c->mesh, &turned, NULL, NULL, NULL), TRIBOX_OK);
    assert_int_equal(tribox_classify(&c->soup, &cube, NULL, NULL, NULL, NULL), TRIBOX_OK);
    assert_int_equal(tribox_find(&c->soup, &cube, NULL, TRIBOX_FIRST_HIT, &out.first), TRIBOX_OK);
    assert_int_equal(tribox_find(&c->soup, &cube, NULL, TRIBOX_FIRST_MISS, &out.first), TRIBOX_OK);
    float *const to[3] = {out.stream[0], out.stream[1], out.stream[2]};
    assert_int_equal(tribox_mesh_to_soup(&c->mesh, NULL, 0, COUNT, NULL, to, to, to), TRIBOX_OK);
    assert_int_equal(tribox_mesh_overlap(NULL, &cube, NULL, NULL, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_overlap_oriented(NULL, &turned, NULL, NULL, NULL), TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_classify(NULL, &cube, NULL, NULL, NULL, NULL), TRIBOX_BAD_ARGUMENT);
}

static void test_null_operands(void **state)
{
    (void)state;
    call *c = right_call();
    c->soup_or_null = NULL;
    c->mesh_or_null = NULL;
    EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->box_or_null = NULL;
    c->oriented_or_null = NULL;
    EXPECT(of_axes, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->has_first = false;
    expect_one(any, c, TRIBOX_BAD_ARGUMENT);
    expect_one(all, c, TRIBOX_BAD_ARGUMENT);
}

static void test_null_streams(void **state)
{
    (void)state;
    for (int s = 0; s < 9; s++) {
        call *const c = right_call();
        const float **const axis[] = {c->soup.x, c->soup.y, c->soup.z};
        axis[s / 3][s % 3] = NULL;
        EXPECT(of_soups, c, TRIBOX_BAD_ARGUMENT);
        c->has_stream[s] = false;
        expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
    }
    for (int a = 0; a < 3; a++) {
        call *const c = right_call();
        c->has_axis[a] = false;
        expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
    }
    call *const c = right_call();
    c->mesh.positions = NULL;
    EXPECT(of_meshes, c, TRIBOX_BAD_ARGUMENT);
}

/* Nothing to do: all that would be read may be NULL, and nothing but the counts is written. */
static void test_count_zero(void **state)
{
    (void)state;
    call *const c = right_call();
    outputs out = poisoned();
    const outputs poison = poisoned();
    c->soup = (tribox_soup){.count = 0};
    c->mesh = (tribox_mesh){.count = 0};
    c->count = 0;
    memset(c->has_stream, false, sizeof c->has_stream);
    EXPECT(of_all, c, TRIBOX_OK);
    for (size_t k = 0; k < sizeof of_all / sizeof of_all[0]; k++)
        assert_int_equal(of_all[k](c, &out), TRIBOX_OK);
    assert_int_equal(out.first, 0);
    assert_int_equal(out.report.overlapping, 0);
    assert_int_equal(out.report.undecided, 0);
    assert_memory_equal(out.mask, poison.mask, sizeof out.mask);
    assert_memory_equal(out.inside, poison.inside, sizeof out.inside);
    assert_memory_equal(out.stream, poison.stream, sizeof out.stream);
    c->mesh.index_bytes = 4;
    EXPECT(of_meshes, c, TRIBOX_OK);
    c->options.axes = 8;
    EXPECT(of_axes, c, TRIBOX_BAD_OPTION);
    c->options = (tribox_options){.kernel = "nope"};
    EXPECT(of_all, c, TRIBOX_NO_KERNEL);
}

/* No triangles asked of a mesh that has some, from each of them and from past the last. */
static void test_no_triangles_of_a_mesh(void **state)
{
    (void)state;
    call *const c = right_call();
    memset(c->has_stream, false, sizeof c->has_stream);
    c->count = 0;
    for (c->first = 0; c->first <= COUNT; c->first++)
        expect_one(streams, c, TRIBOX_OK);
    expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
}

static void test_counts_that_overflow(void **state)
{
    (void)state;
    static const size_t counts[] = {(size_t)PTRDIFF_MAX / sizeof(float) + 1,
                                    SIZE_MAX / sizeof(float),
                                    SIZE_MAX / sizeof(float) + 1,
                                    SIZE_MAX / 3 + 1,
                                    SIZE_MAX / 9 * 4,
                                    SIZE_MAX - 63,
                                    SIZE_MAX - 1,
                                    SIZE_MAX};
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
        for (unsigned bytes = 0; bytes <= 4; bytes += 2) {
            call *const c = right_call();
            c->soup.count = c->mesh.count = counts[k];
            c->mesh.indices = bytes ? narrow : NULL;
            c->mesh.index_bytes = bytes;
            EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
            size_t first = 12345;
            assert_int_equal(tribox_mesh_bad_vertices(&c->mesh, &first), 0);
            assert_int_equal(first, 0);
        }
}

/* Triangles that a mesh does not have. */
static void test_ranges(void **state)
{
    (void)state;
    static const size_t ranges[][2] = {{0, COUNT + 1},      {1, COUNT},          {COUNT, 1},          {COUNT + 1, 0},
                                       {COUNT - 1, 2},      {SIZE_MAX, 0},       {SIZE_MAX, 1},       {SIZE_MAX, 2},
                                       {0, SIZE_MAX},       {1, SIZE_MAX},       {2, SIZE_MAX - 1},   {50, SIZE_MAX - 49},
                                       {SIZE_MAX - 49, 50}, {SIZE_MAX - 49, 51}, {SIZE_MAX, SIZE_MAX}};
    for (size_t k = 0; k < sizeof ranges / sizeof ranges[0]; k++) {
        call *const c = right_call();
        c->first = ranges[k][0];
        c->count = ranges[k][1];
        expect_one(streams, c, TRIBOX_BAD_ARGUMENT);
    }
}

static void expect_bad_mesh(call *c)
{
    size_t first = 12345;
    EXPECT(of_meshes, c, TRIBOX_BAD_ARGUMENT);
    assert_int_equal(tribox_mesh_bad_vertices(&c->mesh, &first), 0);
    assert_int_equal(first, 0);
}

static void test_strides(void **state)
{
    (void)state;
    call *c = right_call();
    for (c->mesh.stride = 1; c->mesh.stride < 12; c->mesh.stride++)
        expect_bad_mesh(c);
    EXPECT(of_meshes, c, TRIBOX_OK);
    c->mesh.count = 0;
    c->count = 0;
    for (c->mesh.stride = 1; c->mesh.stride < 12; c->mesh.stride++)
        expect_bad_mesh(c);
    static const size_t vertices_and_strides[][2] = {
        {3, SIZE_MAX},           {3, SIZE_MAX / 2},         {4, SIZE_MAX / 4 + 1}, {5, SIZE_MAX / 4 + 2}, {SIZE_MAX, 0},
        {SIZE_MAX / 12 + 2, 0},  {SIZE_MAX / 12 + 2, 12},   {SIZE_MAX, 12},        {SIZE_MAX, SIZE_MAX},  {SIZE_MAX, 16},
        {SIZE_MAX / 16 + 2, 16}, {PTRDIFF_MAX / 12 + 2, 0}, {SIZE_MAX, 13},        {1000, SIZE_MAX / 999}};
    for (size_t k = 0; k < sizeof vertices_and_strides / sizeof vertices_and_strides[0]; k++) {
        c = right_call();
        c->mesh.vertices = vertices_and_strides[k][0];
        c->mesh.stride = vertices_and_strides[k][1];
        c->mesh.count = c->count = 1;
        expect_bad_mesh(c);
    }
}

static void test_index_bytes(void **state)
{
    (void)state;
    static const unsigned bad[] = {0, 1, 3, 5, 6, 8, 12, 16, 258, 0x80000002u, UINT_MAX};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        call *const c = right_call();
        c->mesh.index_bytes = bad[k];
        EXPECT(of_meshes, c, TRIBOX_OK);
        c->mesh.indices = narrow;
        expect_bad_mesh(c);
        c->mesh.index_bytes = 2;
        EXPECT(of_meshes, c, TRIBOX_OK);
    }
}

/* No mesh, or no positions: an empty mesh. */
static void test_bad_indices_of_nothing(void **state)
{
    (void)state;
    size_t first = 12345;
    assert_int_equal(tribox_mesh_bad_vertices(NULL, NULL), 0);
    assert_int_equal(tribox_mesh_bad_vertices(NULL, &first), 0);
    assert_int_equal(first, 0);
    call *const c = right_call();
    c->mesh.positions = NULL;
    expect_bad_mesh(c);
    first = 12345;
    assert_int_equal(tribox_mesh_bad_vertices(&(tribox_mesh){.count = 0}, &first), 0);
    assert_int_equal(first, 0);
}

/* A bad index is told as such, after everything else. */
static void test_bad_index_comes_last(void **state)
{
    (void)state;
    call *const c = right_call();
    c->mesh.vertices--;
    EXPECT(of_meshes, c, TRIBOX_BAD_VERTEX);
    c->options.kernel = "nope";
    EXPECT(of_meshes, c, TRIBOX_NO_KERNEL);
    c->options.kernel = NULL;
    c->options.axes = 8;
    expect_one(indexed, c, TRIBOX_BAD_OPTION);
    expect_one(mesh_oriented, c, TRIBOX_BAD_OPTION);
    c->options.axes = TRIBOX_AXES_EDGES;
    expect_one(mesh_oriented, c, TRIBOX_BAD_OPTION);
    expect_one(streams, c, TRIBOX_BAD_VERTEX);
}

static const float not_finite[] = {NAN, -NAN, INFINITY, -INFINITY};

static void test_boxes(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++)
        for (size_t b = 0; b < 4; b++) {
            call *const c = right_call();
            (k < 3 ? c->box.lo : c->box.hi)[k % 3] = not_finite[b];
            EXPECT(of_boxes, c, TRIBOX_BAD_BOX);
            c->soup.count = c->mesh.count = 0;
            EXPECT(of_boxes, c, TRIBOX_BAD_BOX);
        }
}

/* Each of the fifteen numbers; also where another makes the box empty. */
static void test_oriented_boxes(void **state)
{
    (void)state;
    for (int k = 0; k < 15; k++)
        for (size_t b = 0; b < 4; b++)
            for (int empty = -1; empty < 3; empty++) {
                call *const c = right_call();
                if (empty >= 0)
                    c->oriented.half[empty] = -1;
                *(k < 3   ? &c->oriented.center[k]
                  : k < 6 ? &c->oriented.half[k - 3]
                          : &c->oriented.axis[(k - 6) / 3][(k - 6) % 3]) = not_finite[b];
                expect_one(oriented, c, TRIBOX_BAD_BOX);
                expect_one(mesh_oriented, c, TRIBOX_BAD_BOX);
                c->soup.count = c->mesh.count = 0;
                expect_one(oriented, c, TRIBOX_BAD_BOX);
                expect_one(mesh_oriented, c, TRIBOX_BAD_BOX);
            }
}

/* EXACT moves no edge and no plane: it takes all thirteen axes, or those of the box. */
static void test_axes_of_oriented_boxes(void **state)
{
    (void)state;
    static const unsigned orders[] = {0, 123, 132, 213, 231, 312, 321};
    call *const c = right_call();
    for (int is_empty = 0; is_empty < 2; is_empty++)
        for (int count = 0; count <= COUNT; count += COUNT)
            for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
                for (unsigned axes = 0; axes <= TRIBOX_AXES_ALL; axes++)
                    for (size_t o = 0; o < sizeof orders / sizeof orders[0]; o++) {
                        const bool is_right =
                            accuracy != TRIBOX_EXACT || axes == 0 || axes == TRIBOX_AXES_ALL || axes == TRIBOX_AXES_BOX;
                        c->oriented.half[1] = is_empty ? -1 : 1;
                        c->soup.count = c->mesh.count = (size_t)count;
                        c->options = (tribox_options){
                            .accuracy = (tribox_accuracy)accuracy, .axes = axes, .axis_order = orders[o], .kernel = NULL};
                        expect_one(oriented, c, is_right ? TRIBOX_OK : TRIBOX_BAD_OPTION);
                        expect_one(mesh_oriented, c, is_right ? TRIBOX_OK : TRIBOX_BAD_OPTION);
                    }
}

static void test_options(void **state)
{
    (void)state;
    static const int accuracies[] = {3, 99, -1, INT_MAX, INT_MIN};
    static const unsigned axes[] = {8, 9, 15, 0x80000000u, UINT_MAX};
    static const unsigned orders[] = {1, 12, 111, 122, 124, 322, 1123, 0x80000000u + 123, UINT_MAX};
    static const char *const kernels[] = {"", "AVX2", "nope", "scalar ", "sse"};
    call *c = right_call();
    for (size_t k = 0; k < sizeof accuracies / sizeof accuracies[0]; k++) {
        c->options.accuracy = (tribox_accuracy)accuracies[k];
        EXPECT(of_axes, c, TRIBOX_BAD_OPTION);
        expect_one(streams, c, TRIBOX_OK);
    }
    c = right_call();
    for (size_t k = 0; k < sizeof axes / sizeof axes[0]; k++) {
        c->options.axes = axes[k];
        EXPECT(of_axes, c, TRIBOX_BAD_OPTION);
        expect_one(streams, c, TRIBOX_OK);
    }
    c = right_call();
    for (size_t k = 0; k < sizeof orders / sizeof orders[0]; k++) {
        c->options.axis_order = orders[k];
        EXPECT(of_axes, c, TRIBOX_BAD_OPTION);
        expect_one(streams, c, TRIBOX_OK);
    }
    c = right_call();
    for (size_t k = 0; k < sizeof kernels / sizeof kernels[0]; k++) {
        c->options.kernel = kernels[k];
        EXPECT(of_all, c, TRIBOX_NO_KERNEL);
    }
    for (size_t i = 0; i < tribox_kernel_count(); i++) {
        c->options.kernel = tribox_kernel_at(i)->name;
        EXPECT(of_all, c, tribox_kernel_runs_here(i) ? TRIBOX_OK : TRIBOX_NO_KERNEL);
    }
}

static void test_status_text(void **state)
{
    (void)state;
    const char *const text = tribox_status_text(TRIBOX_STOPPED);
    assert_true(strlen(text) > 0 && text[strlen(text) - 1] != '.');
    for (int s = TRIBOX_OK; s < TRIBOX_STOPPED; s++)
        assert_string_not_equal(text, tribox_status_text((tribox_status)s));
    assert_string_equal(tribox_status_text((tribox_status)(TRIBOX_STOPPED + 1)), tribox_status_text((tribox_status)99));
    assert_string_not_equal(text, tribox_status_text((tribox_status)99));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_call),
        cmocka_unit_test(test_absent_outputs),
        cmocka_unit_test(test_null_operands),
        cmocka_unit_test(test_null_streams),
        cmocka_unit_test(test_count_zero),
        cmocka_unit_test(test_no_triangles_of_a_mesh),
        cmocka_unit_test(test_counts_that_overflow),
        cmocka_unit_test(test_ranges),
        cmocka_unit_test(test_strides),
        cmocka_unit_test(test_index_bytes),
        cmocka_unit_test(test_bad_indices_of_nothing),
        cmocka_unit_test(test_bad_index_comes_last),
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_oriented_boxes),
        cmocka_unit_test(test_axes_of_oriented_boxes),
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_status_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
