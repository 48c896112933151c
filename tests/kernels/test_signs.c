/* test_signs.c - what a sign bit could get wrong: boxes of zeros of either sign, NaN from products that overflow, ties. */
#include <math.h>

#include "common/harness.h"
#include "pair_list.h"

static const unsigned orders[] = {123, 132, 213, 231, 312, 321};
enum { ORDERS = sizeof orders / sizeof orders[0], SIGNS = 64, WORDS = 2, COUNT = 70 };

/* In the plane x + y + z = 0, about the origin; and with a corner, an edge or nothing but the origin itself. */
static const float triangles[][3][3] = {
    {{1, 1, -2}, {-2, 1, 1}, {1, -2, 1}},    {{1, -2, 1}, {-2, 1, 1}, {1, 1, -2}}, {{0, 0, 0}, {1, 2, 3}, {-0.0f, 1, -1}},
    {{-1, 1, 0}, {1, -1, -0.0f}, {2, 3, 4}}, {{1, 2, 3}, {-1, -2, -3}, {1, 2, 3}}, {{-0.0f, 0, 0}, {0, -0.0f, 0}, {0, 0, -0.0f}},
};
enum { TRIANGLES = sizeof triangles / sizeof triangles[0] };

static float zero_of(unsigned signs, int bit) { return signs >> bit & 1 ? -0.0f : 0.0f; }

/* All pairs overlap, at every kernel and order, at these accuracies and axes. */
static void check_all_overlap(const pair_list *q, tribox_accuracy first, unsigned least_axes)
{
    uint64_t every[WORDS] = {0}, mask[WORDS] = {0};
    for (size_t i = 0; i < q->count; i++)
        every[i / 64] |= UINT64_C(1) << i % 64;
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = first; accuracy <= TRIBOX_FAST; accuracy++)
            for (unsigned axes = least_axes; axes <= TRIBOX_AXES_ALL; axes++)
                for (int o = 0; o < ORDERS; o++) {
                    const tribox_options options = {
                        .accuracy = accuracy, .axes = axes, .axis_order = orders[o], .kernel = names[k]};
                    ask_ok(q, &options, mask, NULL);
                    assert_masks_equal(q, &options, every, mask);
                }
}

/* Every one of the six bounds +0 or -0: the box is the origin, and the triangle touches it. */
CASE(test_boxes_of_zeros)
{
    static float bound[6][COUNT], coordinate[9][COUNT];
    pair_list boxes = {.count = COUNT}, soup = {.count = COUNT};
    for (int s = 0; s < 6; s++) {
        boxes.stream[s] = bound[s];
        for (unsigned i = 0; i < COUNT; i++)
            bound[s][i] = zero_of(i % SIGNS, s);
    }
    for (int s = 0; s < 9; s++) {
        soup.stream[s] = coordinate[s];
        for (int i = 0; i < COUNT; i++)
            coordinate[s][i] = triangles[i % TRIANGLES][s % 3][s / 3];
    }
    for (int t = 0; t < TRIANGLES; t++) {
        boxes.triangle = triangles[t];
        check_all_overlap(&boxes, TRIBOX_EXACT, 1);
    }
    for (unsigned signs = 0; signs < SIGNS; signs++) {
        const tribox_box box = {{zero_of(signs, 0), zero_of(signs, 1), zero_of(signs, 2)},
                                {zero_of(signs, 3), zero_of(signs, 4), zero_of(signs, 5)}};
        soup.box = &box;
        check_all_overlap(&soup, TRIBOX_EXACT, 1);
    }
}

/* Beyond 2^40, where products of three lengths, then of two, overflow: a lane that is not finite is not taken for apart. */
CASE(test_overflow_is_not_apart)
{
    static float coordinate[9][COUNT];
    for (int power = 20; power <= 125; power++) {
        const float half = (float)ldexp(0.5, power);
        const tribox_box box = {{-half, -half, -half}, {half, half, half}};
        pair_list soup = {.count = COUNT, .box = &box};
        for (int s = 0; s < 9; s++) {
            soup.stream[s] = coordinate[s];
            for (int i = 0; i < COUNT; i++)
                coordinate[s][i] = (float)ldexp((double)triangles[i % 2][s % 3][s / 3], power);
        }
        check_all_overlap(&soup, TRIBOX_FAST, TRIBOX_AXES_ALL);
    }
}

/*
 * FAST: faces in faces of a box on tenths, as in CAD: rounding alone has the sign of such a tie. One in ten may be lost, not one in
 * three; of soups, and of boxes about one triangle.
 */
CASE(test_faces_on_tenths)
{
    static float coordinate[9][COUNT], bound[6][COUNT];
    size_t overlaps[2] = {0}, lost[2][KERNELS_MAX] = {{0}};
    random_source r = random_named(1, "tenths");
    for (int round = 0; round < 400; round++) {
        tribox_box box;
        union {
            float u[3][3];
            const float of[3][3];
        } triangle;
        pair_list q[2] = {{.count = COUNT, .box = &box}, {.count = COUNT, .triangle = triangle.of}};
        const int axis = random_int(&r, 3), side = random_int(&r, 2);
        int lo[3];
        for (int a = 0; a < 3; a++) {
            lo[a] = random_int(&r, 20);
            box.lo[a] = (double)((float)lo[a] / 10);
            box.hi[a] = (double)((float)(lo[a] + 1 + random_int(&r, 5)) / 10);
        }
        for (int i = 0; i < COUNT; i++)
            for (int s = 0; s < 9; s++) {
                const int a = s / 3;
                coordinate[s][i] = a == axis ? (float)(side ? box.hi[a] : box.lo[a]) : (float)(lo[a] - 5 + random_int(&r, 16)) / 10;
                triangle.u[s % 3][a] = coordinate[s][i];
                if (s % 3 < 2)
                    bound[2 * a + s % 3][i] = (float)(s % 3 ? box.hi[a] : box.lo[a]);
            }
        for (int s = 0; s < 9; s++)
            q[0].stream[s] = coordinate[s];
        for (int s = 0; s < 6; s++)
            q[1].stream[s] = bound[s];
        for (int form = 0; form < 2; form++) {
            uint64_t exact[WORDS], mask[WORDS];
            tribox_report report;
            ask_ok(&q[form], NULL, exact, &report);
            overlaps[form] += report.overlapping;
            for (int k = 0; k < kernels; k++) {
                ask_ok(&q[form], &(tribox_options){.accuracy = TRIBOX_FAST, .kernel = names[k]}, mask, NULL);
                for (int i = 0; i < COUNT; i++)
                    lost[form][k] += mask_bit(exact, (size_t)i) && !mask_bit(mask, (size_t)i);
            }
        }
    }
    for (int form = 0; form < 2; form++)
        for (int k = 0; k < kernels; k++)
            if (10 * lost[form][k] > overlaps[form])
                fail_msg("%s: %zu of %zu %s lost", names[k], lost[form][k], overlaps[form], form ? "boxes" : "triangles");
}

PROGRAM(RUN(test_boxes_of_zeros), RUN(test_overflow_is_not_apart), RUN(test_faces_on_tenths))
