/*
 * test_not_finite.c - NaN, infinity and empty boxes overlap nothing, wherever they stand, at every accuracy, order and set of axes;
 * and boxes of zeros of either sign, NaN from products that overflow, and ties are not taken for what they are not.
 */
#include <math.h>

#include "common/harness.h"
#include "drawn_pairs.h"

static drawn_numbers numbers;

/* Two whole words and a tail. */
enum { COUNT = 150, WORDS = (COUNT + 63) / 64 };

static const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}};
static const float triangle[3][3] = {{0.25f, 0.5f, -0.25f}, {3, -2, 0.5f}, {-0.5f, 0.125f, 2}};

static float bad_number(int kind)
{
    static const uint32_t bits[] = {0x7fc00000, 0xffc00000, 0x7f800001, 0x7f800000, 0xff800000};
    float number;
    memcpy(&number, &bits[kind], sizeof number);
    return number;
}
enum { BAD_KINDS = 5 };

/* The lanes that a test spoils: every third, so that each lane of a vector is spoilt somewhere and has sound neighbours. */
static bool is_spoilt(size_t i) { return i % 3 == 1; }

static void expect_all_but_spoilt(uint64_t expected[WORDS])
{
    memset(expected, 0, WORDS * sizeof *expected);
    for (size_t i = 0; i < COUNT; i++)
        expected[i / 64] |= (uint64_t)!is_spoilt(i) << i % 64;
}

/* Asks every kernel in every order, from an accuracy and a set of axes on; the answer is always the same. */
static void check_from(const pair_list *q, const uint64_t expected[WORDS], tribox_accuracy first, unsigned least_axes)
{
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = first; accuracy <= TRIBOX_FAST; accuracy++)
            for (unsigned axes = least_axes; axes <= TRIBOX_AXES_ALL; axes++)
                for (int o = 1; o < AXIS_ORDERS; o++) {
                    const tribox_options options = {
                        .accuracy = accuracy, .axes = axes, .axis_order = axis_order_at(o), .kernel = names[k]};
                    uint64_t mask[WORDS];
                    tribox_report report;
                    pair_list_text(q, &options, doing);
                    ask_ok(q, &options, mask, &report);
                    assert_masks_equal(q, &options, expected, mask);
                    assert_int_equal(report.overlapping, bits_set(expected, tribox_mask_words(q->count)));
                }
}

static void check_everywhere(const pair_list *q, const uint64_t expected[WORDS]) { check_from(q, expected, TRIBOX_EXACT, 1); }

/* Bits of all pairs. */
static const uint64_t every[WORDS] = {~UINT64_C(0), ~UINT64_C(0), ~(~UINT64_C(0) << COUNT % 64)};

/* Triangles with a vertex well inside the cube; every second one is flat on an axis, where min and max are one number. */
static pair_list draw_hits(random_source *r)
{
    for (size_t i = 0; i < COUNT; i++)
        for (int a = 0; a < 3; a++) {
            const int inside = random_int(r, 3);
            for (int v = 0; v < 3; v++)
                numbers.stream[3 * a + v][i] = (float)random_double(r, -0.5, 0.5) * (v == inside ? 1 : 1.5f);
            if (i % 2 && a == (int)(i / 2 % 3))
                numbers.stream[3 * a + 1][i] = numbers.stream[3 * a + 2][i] = numbers.stream[3 * a][i];
        }
    return pairs_over(&numbers, COUNT, &cube, NULL);
}

/* Boxes about the first vertex of the triangle. */
static pair_list draw_boxes(random_source *r)
{
    for (size_t i = 0; i < COUNT; i++)
        for (int a = 0; a < 3; a++) {
            numbers.stream[a][i] = triangle[0][a] - (float)random_double(r, 0.1, 4);
            numbers.stream[3 + a][i] = triangle[0][a] + (float)random_double(r, 0.1, 4);
        }
    return pairs_over(&numbers, COUNT, NULL, triangle);
}

static void assert_first_and_count(const pair_list *q)
{
    const tribox_soup soup = pair_list_soup(q);
    size_t first = 0;
    assert_int_equal(tribox_soup_not_finite(&soup, &first), COUNT / 3);
    assert_int_equal(first, 1);
    assert_int_equal(tribox_soup_not_finite(&soup, NULL), COUNT / 3);
}

CASE(test_sound_pairs_overlap)
{
    random_source r = random_named(args.seed, "sound");
    const pair_list soup = draw_hits(&r);
    check_everywhere(&soup, every);
    const pair_list boxes = draw_boxes(&r);
    check_everywhere(&boxes, every);
}

/* One bad coordinate in each place, or one bad bound. */
static void check_each_stream(pair_list (*draw)(random_source *))
{
    random_source r = random_named(args.seed, "alone");
    uint64_t expected[WORDS];
    expect_all_but_spoilt(expected);
    const pair_list q = draw(&r);
    for (int s = 0; s < pair_list_streams(&q); s++)
        for (int kind = 0; kind < BAD_KINDS; kind++) {
            float sound[COUNT];
            memcpy(sound, numbers.stream[s], sizeof sound);
            for (size_t i = 0; i < COUNT; i++)
                if (is_spoilt(i))
                    numbers.stream[s][i] = bad_number(kind);
            check_everywhere(&q, expected);
            if (q.box)
                assert_first_and_count(&q);
            memcpy(numbers.stream[s], sound, sizeof sound);
        }
}

CASE(test_each_stream_alone)
{
    check_each_stream(draw_hits);
    check_each_stream(draw_boxes);
}

/* Several at once, so that they meet: inf - inf, inf with NaN. */
static void check_several(pair_list (*draw)(random_source *))
{
    random_source r = random_named(args.seed, "several");
    uint64_t expected[WORDS];
    expect_all_but_spoilt(expected);
    for (int round = 0; round < 20; round++) {
        const pair_list q = draw(&r);
        for (size_t i = 0; i < COUNT; i++)
            for (int times = is_spoilt(i) ? random_int_between(&r, 1, 9) : 0; times > 0; times--)
                numbers.stream[random_int(&r, pair_list_streams(&q))][i] = bad_number(random_int(&r, BAD_KINDS));
        check_everywhere(&q, expected);
        if (q.box)
            assert_first_and_count(&q);
    }
}

/* A bad triangle, or one apart, in the second of two words in the cube, of which walks ask no more than that (inside.h). */
CASE(test_bad_in_words_inside)
{
    random_source r = random_named(args.seed, "inside");
    const pair_list q = draw_hits(&r);
    for (int s = 0; s < SOUP_STREAMS; s++)
        for (int kind = 0; kind < BAD_KINDS + 2; kind++) {
            const size_t bad = 64 + (size_t)random_int(&r, 64);
            uint64_t expected[WORDS] = {~UINT64_C(0), ~(UINT64_C(1) << bad % 64), ~(~UINT64_C(0) << COUNT % 64)};
            for (int k = 0; k < SOUP_STREAMS; k++)
                for (size_t i = 0; i < COUNT; i++)
                    numbers.stream[k][i] = (float)random_double(&r, -0.5, 0.5);
            if (kind < BAD_KINDS)
                numbers.stream[s][bad] = bad_number(kind);
            for (int v = 0; kind >= BAD_KINDS && v < 3; v++)
                numbers.stream[s / 3 * 3 + v][bad] = kind == BAD_KINDS ? -3 : 3;
            check_everywhere(&q, expected);
        }
}

CASE(test_several_at_once)
{
    check_several(draw_hits);
    check_several(draw_boxes);
}

/* In the plane x + y = 2, across the edge x = y = 1 of the cube: it touches there, which a filter leaves undecided. */
static const float touching[3][3] = {{2.25f, -0.25f, 0.5f}, {-0.25f, 2.25f, 0.25f}, {1.25f, 0.75f, -2}};

/* The sound triangles are left to a slower stage, the bad ones are not counted. */
static void check_undecided(const pair_list *q)
{
    for (int k = 0; k < kernels; k++) {
        const tribox_options options = {.accuracy = TRIBOX_CONSERVATIVE, .kernel = names[k]};
        uint64_t mask[WORDS];
        tribox_report report;
        pair_list_text(q, &options, doing);
        ask_ok(q, &options, mask, &report);
        if (report.undecided != COUNT - COUNT / 3)
            fail_msg("%s: %zu undecided, not %d", doing, report.undecided, COUNT - COUNT / 3);
    }
}

/* Bad triangles that are settled beside sound ones. They have a vertex well inside the cube. */
CASE(test_bad_beside_undecided)
{
    uint64_t expected[WORDS];
    expect_all_but_spoilt(expected);
    const pair_list q = pairs_over(&numbers, COUNT, &cube, NULL);
    for (int place = 3; place < 9; place++)
        for (int kind = 0; kind < BAD_KINDS; kind++) {
            for (size_t i = 0; i < COUNT; i++)
                for (int k = 0; k < 9; k++) {
                    const float from = is_spoilt(i) ? triangle[k / 3][k % 3] : touching[k / 3][k % 3];
                    numbers.stream[3 * (k % 3) + k / 3][i] = is_spoilt(i) && k == place ? bad_number(kind) : from;
                }
            check_everywhere(&q, expected);
            check_undecided(&q);
        }
}

CASE(test_bad_triangle_and_many_boxes)
{
    random_source r = random_named(args.seed, "bad triangle");
    static const uint64_t none[WORDS];
    pair_list q = draw_boxes(&r);
    for (int place = 0; place < 9; place++)
        for (int kind = 0; kind < BAD_KINDS; kind++) {
            float bad[3][3];
            memcpy(bad, triangle, sizeof bad);
            bad[place / 3][place % 3] = bad_number(kind);
            q.triangle = (const float(*)[3])bad;
            check_everywhere(&q, none);
        }
}

/* lo > hi on one axis, by an ulp and by much: triangles that span the gap are on no side of it. */
static void empty_box(tribox_box *box, int axis, int gap)
{
    box->hi[axis] = gap ? -0.5f : 0.125f;
    box->lo[axis] = gap ? 0.5f : nextafterf(0.125f, 1);
}

CASE(test_empty_boxes)
{
    random_source r = random_named(args.seed, "empty");
    static const uint64_t none[WORDS];
    uint64_t expected[WORDS];
    expect_all_but_spoilt(expected);
    for (int axis = 0; axis < 3; axis++)
        for (int gap = 0; gap < 2; gap++) {
            tribox_box box = cube;
            empty_box(&box, axis, gap);
            pair_list q = draw_hits(&r);
            q.box = &box;
            check_everywhere(&q, none);
            q = draw_boxes(&r);
            for (size_t i = 0; i < COUNT; i++)
                if (is_spoilt(i)) {
                    numbers.stream[axis][i] = (float)box.lo[axis];
                    numbers.stream[3 + axis][i] = (float)box.hi[axis];
                }
            check_everywhere(&q, expected);
        }
}

/* Nothing but bad triangles, none, and one at the very end. */
CASE(test_counts)
{
    random_source r = random_named(args.seed, "counts");
    const pair_list q = draw_hits(&r);
    const tribox_soup soup = pair_list_soup(&q);
    size_t first = 1234;
    assert_int_equal(tribox_soup_not_finite(&soup, &first), 0);
    assert_int_equal(first, COUNT);
    numbers.stream[8][COUNT - 1] = NAN;
    assert_int_equal(tribox_soup_not_finite(&soup, &first), 1);
    assert_int_equal(first, COUNT - 1);
    for (size_t i = 0; i < COUNT; i++)
        numbers.stream[i % SOUP_STREAMS][i] = INFINITY;
    assert_int_equal(tribox_soup_not_finite(&soup, &first), COUNT);
    assert_int_equal(first, 0);
}

/* What a sign bit could get wrong. */

/* In the plane x + y + z = 0, about the origin; and with a corner, an edge or nothing but the origin itself. */
static const float about_origin[][3][3] = {
    {{1, 1, -2}, {-2, 1, 1}, {1, -2, 1}},    {{1, -2, 1}, {-2, 1, 1}, {1, 1, -2}}, {{0, 0, 0}, {1, 2, 3}, {-0.0f, 1, -1}},
    {{-1, 1, 0}, {1, -1, -0.0f}, {2, 3, 4}}, {{1, 2, 3}, {-1, -2, -3}, {1, 2, 3}}, {{-0.0f, 0, 0}, {0, -0.0f, 0}, {0, 0, -0.0f}},
};
enum { TRIANGLES = sizeof about_origin / sizeof about_origin[0], SIGNS = 64 };

static float zero_of(unsigned signs, int bit) { return signs >> bit & 1 ? -0.0f : 0.0f; }

/* Every one of the six bounds +0 or -0: the box is the origin, and the triangle touches it. */
CASE(test_boxes_of_zeros)
{
    for (int n = 0; n < BOXES_STREAMS * COUNT; n++)
        numbers.stream[n / COUNT][n % COUNT] = zero_of((unsigned)n % COUNT % SIGNS, n / COUNT);
    for (int t = 0; t < TRIANGLES; t++) {
        const pair_list boxes = pairs_over(&numbers, COUNT, NULL, about_origin[t]);
        check_everywhere(&boxes, every);
    }
    for (int n = 0; n < SOUP_STREAMS * COUNT; n++)
        numbers.stream[n / COUNT][n % COUNT] = about_origin[n % COUNT % TRIANGLES][n / COUNT % 3][n / COUNT / 3];
    for (unsigned signs = 0; signs < SIGNS; signs++) {
        const tribox_box box = {{zero_of(signs, 0), zero_of(signs, 1), zero_of(signs, 2)},
                                {zero_of(signs, 3), zero_of(signs, 4), zero_of(signs, 5)}};
        const pair_list soup = pairs_over(&numbers, COUNT, &box, NULL);
        check_everywhere(&soup, every);
    }
}

/* Beyond 2^40, where products of three lengths, then of two, overflow: a lane that is not finite is not taken for apart. */
CASE(test_overflow_is_not_apart)
{
    for (int power = 20; power <= 125; power++) {
        const float half = (float)ldexp(0.5, power);
        const tribox_box box = {{-half, -half, -half}, {half, half, half}};
        const pair_list soup = pairs_over(&numbers, COUNT, &box, NULL);
        for (int n = 0; n < SOUP_STREAMS * COUNT; n++)
            numbers.stream[n / COUNT][n % COUNT] =
                (float)ldexp((double)about_origin[n % COUNT % 2][n / COUNT % 3][n / COUNT / 3], power);
        check_from(&soup, every, TRIBOX_FAST, TRIBOX_AXES_ALL);
    }
}

/*
 * FAST: faces in faces of a box on tenths, as in CAD: rounding alone has the sign of such a tie. One in ten may be lost, not one in
 * three; of soups, and of boxes about one triangle.
 */
CASE(test_faces_on_tenths)
{
    static drawn_numbers bounds;
    size_t overlaps[2] = {0}, lost[2][KERNELS_MAX] = {{0}};
    random_source r = random_named(1, "tenths");
    for (int round = 0; round < 400; round++) {
        tribox_box box;
        union {
            float u[3][3];
            const float of[3][3];
        } last;
        const pair_list q[2] = {pairs_over(&numbers, COUNT, &box, NULL), pairs_over(&bounds, COUNT, NULL, last.of)};
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
                numbers.stream[s][i] =
                    a == axis ? (float)(side ? box.hi[a] : box.lo[a]) : (float)(lo[a] - 5 + random_int(&r, 16)) / 10;
                last.u[s % 3][a] = numbers.stream[s][i];
                if (s % 3 < 2)
                    bounds.stream[2 * a + s % 3][i] = (float)(s % 3 ? box.hi[a] : box.lo[a]);
            }
        for (int form = 0; form < 2; form++) {
            uint64_t exact[WORDS], mask[WORDS];
            tribox_report report;
            ask_ok(&q[form], NULL, exact, &report);
            overlaps[form] += report.overlapping;
            for (int k = 0; k < kernels; k++) {
                ask_ok(&q[form], &(tribox_options){.accuracy = TRIBOX_FAST, .kernel = names[k]}, mask, NULL);
                for (int i = 0; i < COUNT; i++)
                    lost[form][k] += bit_of(exact, (size_t)i) && !bit_of(mask, (size_t)i);
            }
        }
    }
    for (int form = 0; form < 2; form++)
        for (int k = 0; k < kernels; k++)
            if (10 * lost[form][k] > overlaps[form])
                fail_msg("%s: %zu of %zu %s lost", names[k], lost[form][k], overlaps[form], form ? "boxes" : "triangles");
}

PROGRAM(RUN(test_sound_pairs_overlap), RUN(test_each_stream_alone), RUN(test_bad_in_words_inside), RUN(test_several_at_once),
        RUN(test_bad_beside_undecided), RUN(test_bad_triangle_and_many_boxes), RUN(test_empty_boxes), RUN(test_counts),
        RUN(test_boxes_of_zeros), RUN(test_overflow_is_not_apart), RUN(test_faces_on_tenths))
