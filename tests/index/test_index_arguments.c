/* test_index_arguments.c - bad input of every kind to calls about an index is named by its status, and nothing is written. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tribox.h"

enum { COUNT = 100, WORDS = 2, BOXES = 3, NODES = 4096, VERTICES = 33 };

static const float zeros[COUNT];
static uint16_t vertex_numbers[3 * COUNT];
static unsigned char nodes[NODES];

/* A call's arguments, right until a test spoils one. */
typedef struct call {
    tribox_soup soup;
    tribox_mesh mesh;
    tribox_index index;
    const tribox_index *index_or_null;
    tribox_box box;
    tribox_oriented_box oriented;
    tribox_region region, turned;
    bool has_region;
    tribox_boxes boxes;
    const tribox_boxes *boxes_or_null;
    tribox_options options;
    size_t first, count, room;
    bool has_memory, has_place, has_bits, has_found; /* of outputs: the index's memory, number or list, bits, what is found */
} call;

/* Valid until the next one. */
static call *right_call(void)
{
    static call c;
    c = (call){.soup = {{zeros, zeros, zeros}, {zeros, zeros, zeros}, {zeros, zeros, zeros}, COUNT},
               .mesh = {.positions = zeros, .indices = vertex_numbers, .vertices = VERTICES, .index_bytes = 2, .count = COUNT},
               .box = {{-1, -1, -1}, {1, 1, 1}},
               .oriented = {{0, 0, 0}, {1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
               .boxes = {{zeros, zeros, zeros}, {zeros, zeros, zeros}, BOXES},
               .count = COUNT,
               .room = COUNT,
               .has_region = true,
               .has_memory = true,
               .has_place = true,
               .has_bits = true,
               .has_found = true};
    c.index = (tribox_index){.nodes = nodes, .soup = &c.soup};
    c.region.box = &c.box;
    c.turned.oriented = &c.oriented;
    c.index_or_null = &c.index;
    c.boxes_or_null = &c.boxes;
    return &c;
}

/* All that can be written, poisoned before a call and compared after it. */
typedef struct outputs {
    unsigned char nodes[NODES];
    uint64_t mask[WORDS], bits[COUNT], inside[COUNT];
    uint32_t place[BOXES * COUNT];
    size_t start[BOXES + 1], found;
    tribox_report report;
} outputs;

typedef tribox_status ask(const call *c, outputs *out);

static const tribox_region *region_of(const call *c) { return c->has_region ? &c->region : NULL; }
static const tribox_region *turned_of(const call *c) { return c->has_region ? &c->turned : NULL; }

static tribox_status build(const call *c, outputs *out)
{
    return tribox_index_build(c->index_or_null, &c->options, c->has_memory ? out->nodes : NULL);
}

static tribox_status update(const call *c, outputs *out)
{
    return tribox_index_update(c->index_or_null, c->first, c->count, &c->options, c->has_memory ? out->nodes : NULL);
}

static tribox_status overlap(const call *c, outputs *out)
{
    return tribox_index_overlap(c->index_or_null, region_of(c), &c->options, out->mask, &out->report);
}

static tribox_status words(const call *c, outputs *out)
{
    return tribox_index_words(c->index_or_null, region_of(c), &c->options, c->room, c->has_place ? out->place : NULL,
                              c->has_bits ? out->bits : NULL, out->inside, c->has_found ? &out->found : NULL, &out->report);
}

static tribox_status list(const call *c, outputs *out)
{
    return tribox_index_list(c->index_or_null, region_of(c), &c->options, c->room, c->has_place ? out->place : NULL,
                             c->has_found ? &out->found : NULL);
}

static tribox_status lists(const call *c, outputs *out)
{
    return tribox_index_lists(c->index_or_null, c->boxes_or_null, &c->options, c->room, c->has_place ? out->place : NULL,
                              c->has_found ? out->start : NULL);
}

static tribox_status any(const call *c, outputs *out)
{
    return tribox_index_any(c->index_or_null, region_of(c), &c->options, c->has_found ? &out->found : NULL);
}

static tribox_status overlap_oriented(const call *c, outputs *out)
{
    return tribox_index_overlap(c->index_or_null, turned_of(c), &c->options, out->mask, &out->report);
}

static tribox_status words_oriented(const call *c, outputs *out)
{
    return tribox_index_words(c->index_or_null, turned_of(c), &c->options, c->room, c->has_place ? out->place : NULL,
                              c->has_bits ? out->bits : NULL, NULL, c->has_found ? &out->found : NULL, &out->report);
}

static tribox_status any_oriented(const call *c, outputs *out)
{
    return tribox_index_any(c->index_or_null, turned_of(c), &c->options, c->has_found ? &out->found : NULL);
}

static tribox_status list_oriented(const call *c, outputs *out)
{
    return tribox_index_list(c->index_or_null, turned_of(c), &c->options, c->room, c->has_place ? out->place : NULL,
                             c->has_found ? &out->found : NULL);
}

static ask *const of_all[] = {build, update,           overlap,       words,          list,        lists,
                              any,   overlap_oriented, list_oriented, words_oriented, any_oriented};
static ask *const of_builds[] = {build, update};
static ask *const of_questions[] = {overlap,          words,         list,           lists,       any,
                                    overlap_oriented, list_oriented, words_oriented, any_oriented};
static ask *const of_one_box[] = {overlap, words, list, any};
static ask *const of_oriented[] = {overlap_oriented, list_oriented, words_oriented, any_oriented};
static ask *const of_found[] = {words, list, lists, any, list_oriented, words_oriented, any_oriented};
static ask *const of_lists[] = {list, lists, list_oriented};
static ask *const of_places[] = {words, list, lists, list_oriented, words_oriented};

static void expect_one(ask *which, const call *c, tribox_status expected)
{
    static outputs out, poison;
    memset(&out, 0xa5, sizeof out);
    memset(&poison, 0xa5, sizeof poison);
    assert_int_equal(which(c, &out), expected);
    if (expected)
        assert_memory_equal(&out, &poison, sizeof out);
}

#define EXPECT(calls, c, status) \
    do { \
        for (size_t k_ = 0; k_ < sizeof(calls) / sizeof *(calls); k_++) \
            expect_one((calls)[k_], c, status); \
    } while (0)

static void use_mesh(call *c)
{
    c->index.soup = NULL;
    c->index.mesh = &c->mesh;
}

static void test_right_call(void **state)
{
    (void)state;
    EXPECT(of_all, right_call(), TRIBOX_OK);
    static outputs out;
    call *const c = right_call();
    for (int of_mesh = 0; of_mesh < 2; of_mesh++) {
        assert_int_equal(tribox_index_build(&c->index, NULL, out.nodes), TRIBOX_OK);
        assert_int_equal(tribox_index_update(&c->index, 0, 1, NULL, out.nodes), TRIBOX_OK);
        assert_int_equal(tribox_index_overlap(&c->index, &c->region, NULL, NULL, NULL), TRIBOX_OK);
        assert_int_equal(tribox_index_words(&c->index, &c->region, NULL, 0, NULL, NULL, NULL, &out.found, NULL), TRIBOX_OK);
        assert_int_equal(out.found, WORDS);
        assert_int_equal(tribox_index_list(&c->index, &c->region, NULL, 0, NULL, &out.found), TRIBOX_OK);
        assert_int_equal(out.found, COUNT);
        assert_int_equal(tribox_index_lists(&c->index, &c->boxes, NULL, 0, NULL, out.start), TRIBOX_OK);
        assert_int_equal(out.start[BOXES], BOXES * COUNT);
        assert_int_equal(tribox_index_any(&c->index, &c->region, NULL, &out.found), TRIBOX_OK);
        assert_true(out.found < COUNT);
        use_mesh(c);
    }
    EXPECT(of_builds, c, TRIBOX_OK);
    EXPECT(of_one_box, c, TRIBOX_OK);
    expect_one(lists, c, TRIBOX_OK);
}

static void test_null(void **state)
{
    (void)state;
    call *c = right_call();
    c->index.soup = NULL;
    EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->has_memory = false;
    EXPECT(of_builds, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->index_or_null = NULL;
    EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->index.nodes = NULL;
    EXPECT(of_questions, c, TRIBOX_BAD_ARGUMENT);
    EXPECT(of_builds, c, TRIBOX_OK);
    c = right_call();
    c->has_region = false;
    EXPECT(of_one_box, c, TRIBOX_BAD_ARGUMENT);
    EXPECT(of_oriented, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->boxes_or_null = NULL;
    expect_one(lists, c, TRIBOX_BAD_ARGUMENT);
}

/* One of two pointers, and not both: what an index is over, and what a region is. */
static void test_one_of_two(void **state)
{
    (void)state;
    call *c = right_call();
    c->index.mesh = &c->mesh;
    EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->region = c->turned = (tribox_region){NULL, NULL};
    EXPECT(of_one_box, c, TRIBOX_BAD_ARGUMENT);
    EXPECT(of_oriented, c, TRIBOX_BAD_ARGUMENT);
    c->region = (tribox_region){&c->box, &c->oriented};
    EXPECT(of_one_box, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->region = c->turned;
    expect_one(words, c, TRIBOX_BAD_ARGUMENT); /* nothing is said to be inside of an oriented box */
}

static void test_reserved(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        call *c = right_call();
        c->index.reserved[k] = 1;
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
        c = right_call();
        c->options.reserved[k] = 1u << 31;
        EXPECT(of_questions, c, TRIBOX_BAD_OPTION);
    }
}

/* What tribox_mesh_overlap refuses; vertices are looked at where they are read first. */
static void test_meshes(void **state)
{
    (void)state;
    for (int k = 0; k < 5; k++) {
        call *const c = right_call();
        use_mesh(c);
        if (k == 0)
            c->mesh.positions = NULL;
        else if (k == 1)
            c->mesh.stride = 11;
        else if (k == 2)
            c->mesh.index_bytes = 3;
        else if (k == 3)
            c->mesh.position_bytes = 5;
        else
            c->mesh.reserved[3] = 1;
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    }
    call *const c = right_call();
    use_mesh(c);
    vertex_numbers[3 * COUNT - 1] = VERTICES;
    EXPECT(of_builds, c, TRIBOX_BAD_VERTEX);
    EXPECT(of_one_box, c, TRIBOX_OK);
    vertex_numbers[3 * COUNT - 1] = 0;
    c->count = 0;
    expect_one(update, c, TRIBOX_OK);
}

static void test_null_streams(void **state)
{
    (void)state;
    for (int k = 0; k < 9; k++) {
        call *const c = right_call();
        (k < 3 ? c->soup.x : k < 6 ? c->soup.y : c->soup.z)[k % 3] = NULL;
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
    }
    for (int k = 0; k < 6; k++) {
        call *const c = right_call();
        (k < 3 ? c->boxes.lo : c->boxes.hi)[k % 3] = NULL;
        expect_one(lists, c, TRIBOX_BAD_ARGUMENT);
    }
}

static void test_null_outputs(void **state)
{
    (void)state;
    call *c = right_call();
    c->has_found = false;
    EXPECT(of_found, c, TRIBOX_BAD_ARGUMENT);
    c = right_call();
    c->has_place = false;
    c->room = 1;
    EXPECT(of_places, c, TRIBOX_BAD_ARGUMENT);
    c->room = 0;
    EXPECT(of_places, c, TRIBOX_OK);
    c = right_call();
    c->has_bits = false;
    expect_one(words, c, TRIBOX_BAD_ARGUMENT);
    c->room = 0;
    expect_one(words, c, TRIBOX_OK);
}

/* Of a soup that is larger than any. */
static void test_counts(void **state)
{
    (void)state;
    static const size_t huge[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / sizeof(float), PTRDIFF_MAX / sizeof(float) + 1};
    for (size_t k = 0; k < sizeof huge / sizeof huge[0]; k++) {
        call *c = right_call();
        c->soup.count = huge[k];
        EXPECT(of_all, c, TRIBOX_BAD_ARGUMENT);
        c = right_call();
        c->boxes.count = huge[k];
        expect_one(lists, c, TRIBOX_BAD_ARGUMENT);
    }
}

#if SIZE_MAX > UINT32_MAX
/* More than numbers of 32 bits can name. Nothing of so many is read. */
static void test_too_many_for_numbers(void **state)
{
    (void)state;
    call *const c = right_call();
    c->soup.count = ((size_t)1 << 32) + 1;
    EXPECT(of_lists, c, TRIBOX_BAD_ARGUMENT);
    c->soup.count = ((size_t)1 << 38) + 1;
    expect_one(words, c, TRIBOX_BAD_ARGUMENT);
}
#endif

static void test_ranges(void **state)
{
    (void)state;
    static const size_t bad[][2] = {{0, COUNT + 1},    {1, COUNT},       {COUNT, 1},           {COUNT + 1, 0},
                                    {SIZE_MAX, 1},     {1, SIZE_MAX},    {SIZE_MAX, SIZE_MAX}, {COUNT, SIZE_MAX - COUNT + 1},
                                    {SIZE_MAX / 2, 0}, {0, SIZE_MAX / 2}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        call *const c = right_call();
        c->first = bad[k][0];
        c->count = bad[k][1];
        expect_one(update, c, TRIBOX_BAD_ARGUMENT);
    }
    call *const c = right_call();
    c->first = COUNT;
    c->count = 0;
    expect_one(update, c, TRIBOX_OK);
}

static void test_boxes(void **state)
{
    (void)state;
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (size_t k = 0; k < 6 * 4; k++) {
        call *const c = right_call();
        (k < 12 ? c->box.lo : c->box.hi)[k % 3] = bad[k / 3 % 4];
        EXPECT(of_one_box, c, TRIBOX_BAD_BOX);
    }
    for (size_t k = 0; k < 15; k++) {
        call *const c = right_call();
        (k < 3 ? c->oriented.center : k < 6 ? c->oriented.half : c->oriented.axis[k / 3 - 2])[k % 3] = bad[k % 4];
        EXPECT(of_oriented, c, TRIBOX_BAD_BOX);
    }
}

/* EXACT answers about oriented boxes with all axes or with those of the box alone. */
static void test_axes_of_oriented_boxes(void **state)
{
    (void)state;
    for (unsigned axes = TRIBOX_AXES_BOX; axes <= TRIBOX_AXES_ALL; axes += 2)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            call *const c = right_call();
            c->options = (tribox_options){.accuracy = accuracy, .axes = axes};
            EXPECT(of_one_box, c, TRIBOX_OK);
            const bool has = accuracy != TRIBOX_EXACT || axes == TRIBOX_AXES_BOX || axes == TRIBOX_AXES_ALL;
            EXPECT(of_oriented, c, has ? TRIBOX_OK : TRIBOX_BAD_OPTION);
        }
}

/* Only the kernel counts for those that build. */
static void test_options(void **state)
{
    (void)state;
    static const tribox_options bad[] = {
        {.accuracy = (tribox_accuracy)3},
        {.accuracy = (tribox_accuracy)INT_MAX},
        {.axes = 8},
        {.axes = UINT_MAX},
        {.axis_order = 1},
        {.axis_order = 124},
        {.axis_order = 12},
        {.axes = TRIBOX_AXES_PLANE},
        {.axes = TRIBOX_AXES_EDGES},
        {.axes = TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        call *const c = right_call();
        c->options = bad[k];
        EXPECT(of_questions, c, TRIBOX_BAD_OPTION);
        EXPECT(of_builds, c, TRIBOX_OK);
    }
    call *const c = right_call();
    c->options.kernel = "none";
    EXPECT(of_all, c, TRIBOX_NO_KERNEL);
}

/* No triangles, no boxes: streams may be NULL, and what is wrong besides stays wrong. */
static void test_nothing(void **state)
{
    (void)state;
    static outputs out;
    call *c = right_call();
    const tribox_soup soup = {.count = 0};
    c->soup = soup;
    c->first = c->count = 0;
    EXPECT(of_all, c, TRIBOX_OK);
    assert_int_equal(list(c, &out), TRIBOX_OK);
    assert_int_equal(out.found, 0);
    assert_int_equal(any(c, &out), TRIBOX_OK);
    assert_int_equal(out.found, 0);
    c->index.nodes = NULL;
    EXPECT(of_questions, c, TRIBOX_BAD_ARGUMENT);
    c->index.nodes = nodes;
    c->has_memory = false;
    EXPECT(of_builds, c, TRIBOX_BAD_ARGUMENT);
    c->box.lo[0] = NAN;
    EXPECT(of_one_box, c, TRIBOX_BAD_BOX);
    c->options.axes = TRIBOX_AXES_PLANE;
    expect_one(lists, c, TRIBOX_BAD_OPTION);
    c = right_call();
    memset(&c->boxes, 0, sizeof c->boxes);
    memset(&out, 0xa5, sizeof out);
    assert_int_equal(lists(c, &out), TRIBOX_OK);
    assert_int_equal(out.start[0], 0);
    assert_true(out.start[1] != 0);
}

int main(void)
{
    if (tribox_index_bytes(COUNT) > NODES)
        return 1;
    const call *const c = right_call();
    if (tribox_index_build(&c->index, NULL, nodes))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_call),
        cmocka_unit_test(test_null),
        cmocka_unit_test(test_one_of_two),
        cmocka_unit_test(test_reserved),
        cmocka_unit_test(test_meshes),
        cmocka_unit_test(test_null_streams),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_ranges),
        cmocka_unit_test(test_null_outputs),
        cmocka_unit_test(test_axes_of_oriented_boxes),
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_nothing),
#if SIZE_MAX > UINT32_MAX
        cmocka_unit_test(test_too_many_for_numbers),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
