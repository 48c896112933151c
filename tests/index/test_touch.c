/*
 * test_touch.c - each of the twelve comparisons of a node decides alone: a box that touches a word or node with one face, misses it
 * by an ulp, or holds it with that face in common.
 *
 * What is missed or wholly inside is not even read: the streams cannot be touched while that is asked.
 */
#include <float.h>
#include <math.h>

#include "common/harness.h"
#include "hostile.h"
#include "forms.h"

enum { COUNT = 64 * TRIBOX_INDEX_BLOCK + 64, FACES = 6 };

static int make_all(void) { return index_fixture_make(COUNT, 1); }

/* A part of the soup that is one word or one whole node of some level. */
typedef struct part {
    size_t first, count;
} part;

/* A part within 4 units of a point, of which it touches all six planes there, and the rest of the soup far away. */
static void draw_part(random_source *r, const part *p, size_t count, const float middle[3], float unit)
{
    stored_soup_lay(count, STORED_AT_END);
    for (size_t i = 0; i < count; i++) {
        const bool is_in = i >= p->first && i - p->first < p->count;
        for (int k = 0; k < STORED_STREAMS; k++) {
            const float place = (float)random_int_between(r, -4, 4);
            stored.stream[k][i] = unit * (is_in ? middle[k / 3] + place : 1000 + place);
        }
    }
}

/* The next float. */
static float next(float bound, bool is_up) { return nextafterf(bound, is_up ? FLT_MAX : -FLT_MAX); }

/* A box about the part with room to all sides, but that one face is at `bound`. */
static tribox_box box_to(const tribox_box *about, int face, float bound, float room)
{
    tribox_box box = *about;
    for (int a = 0; a < 3; a++) {
        box.lo[a] -= room;
        box.hi[a] += room;
    }
    *(face < 3 ? &box.lo[face] : &box.hi[face - 3]) = bound;
    return box;
}

static void expect_unseen(const tribox_box *box, const tribox_options *options, const char *how, int face, size_t expected)
{
    const size_t found = count_unseen(&(tribox_region){.box = box}, options, how);
    if (found != expected)
        fail_msg("%s: face %d: %zu overlap, not %zu", doing, face, found, expected);
}

/* As many as without the index, which at FAST finds no more than with it. */
static size_t count_as_without(const tribox_box *box, const tribox_options *options)
{
    tribox_report report = {0, 0}, without = {0, 0};
    assert_int_equal(tribox_index_overlap(&stored.index, &(tribox_region){.box = box}, options, NULL, &report), TRIBOX_OK);
    assert_int_equal(tribox_overlap(&stored.soup, box, options, NULL, &without), TRIBOX_OK);
    if (options->accuracy == TRIBOX_FAST ? report.overlapping < without.overlapping : report.overlapping != without.overlapping)
        fail_msg("%zu overlap, without the index %zu", report.overlapping, without.overlapping);
    return report.overlapping;
}

static void check_face(const part *p, const tribox_box *about, int face, float unit, const tribox_options *options)
{
    const bool is_lower = face < 3;
    const float near = is_lower ? (float)about->lo[face] : (float)about->hi[face - 3],
                far = is_lower ? (float)about->hi[face] : (float)about->lo[face - 3];
    const tribox_box touching = box_to(about, face, far, 3 * unit), missing = box_to(about, face, next(far, is_lower), 3 * unit);
    const tribox_box holding = box_to(about, face, near, 3 * unit), cutting = box_to(about, face, next(near, is_lower), 3 * unit);
    if (!count_as_without(&touching, options))
        fail_msg("face %d: nothing touches", face);
    count_as_without(&cutting, options);
    expect_unseen(&missing, options, "missed by an ulp", face, 0);
    expect_unseen(&holding, options, "inside with a face in common", face, p->count);
    expect_unseen(about, options, "inside with all faces in common", FACES, p->count);
}

static void check_part(random_source *r, const part *p, size_t count, const float middle[3], float unit)
{
    draw_part(r, p, count, middle, unit);
    const tribox_box about = bounds_of(p->first, p->count);
    for (int k = 0; k < kernels; k++) {
        stored_build(names[k]);
        for (int face = 0; face < FACES; face++) {
            const tribox_options options = {.accuracy = (tribox_accuracy)((face + k) % 3), .kernel = names[k]};
            check_face(p, &about, face, unit, &options);
        }
        check_forms(&about, &(tribox_options){.kernel = names[k]}, "all faces in common");
    }
}

static const float here[3] = {5, -20, 33}, about_zero[3] = {0, 0, 0}, at_zero[3] = {4, -4, 4};

/* Each of the 64 words of a node, in its place in every vector; the other node is far away. */
CASE(test_each_word)
{
    random_source r = random_named(args.seed, "each word");
    for (size_t word = 0; word < 64; word++) {
        const part p = {64 * word, 64};
        check_part(&r, &p, TRIBOX_INDEX_BLOCK, word % 3 ? here : word % 2 ? about_zero : at_zero, 1);
    }
}

/* Bounds at the ends of the range: subnormal, and next to FLT_MAX. */
CASE(test_ends_of_range)
{
    random_source r = random_named(args.seed, "ends of range");
    const part p = {128, 64};
    check_part(&r, &p, 1000, here, 0x1p-149f);
    check_part(&r, &p, 1000, about_zero, 0x1p-149f);
    check_part(&r, &p, 1000, here, 0x1p-127f);
    check_part(&r, &p, 1000, here, 0x1p117f);
}

/* Nodes of the second and the third level. */
CASE(test_nodes)
{
    random_source r = random_named(args.seed, "nodes");
    const part second = {TRIBOX_INDEX_BLOCK, TRIBOX_INDEX_BLOCK}, third = {0, 64 * TRIBOX_INDEX_BLOCK};
    check_part(&r, &second, 3 * TRIBOX_INDEX_BLOCK, here, 1);
    check_part(&r, &third, COUNT, at_zero, 1);
}

/* A zero of one sign is the other one's neighbour in nothing: they touch. */
CASE(test_zeros)
{
    const part p = {64, 64};
    random_source r = random_named(args.seed, "zeros");
    for (int signs = 0; signs < 8; signs++)
        for (int face = 0; face < FACES; face++)
            for (int k = 0; k < kernels; k++) {
                draw_part(&r, &p, 200, at_zero, 1);
                for (int stream = 0; stream < STORED_STREAMS; stream++)
                    for (size_t i = p.first; i < p.first + p.count; i++) {
                        float *const u = &stored.stream[stream][i];
                        *u = *u != 0 ? *u : signs & 1 ? -0.0f : random_sign_of_zero(&r, 0.0f);
                    }
                stored_build(names[k]);
                const tribox_box about = bounds_of(p.first, p.count);
                const float zero = signs & 2 ? -0.0f : 0.0f;
                const tribox_options options = {.accuracy = (tribox_accuracy)(signs % 3), .kernel = names[k]};
                const tribox_box box = box_to(&about, face, zero, 1);
                check_forms(&box, &options, "zeros");
                if (about.lo[face % 3] == 0 ? face < 3 : face >= 3)
                    expect_unseen(&box, &options, "inside with a face at zero", face, p.count);
            }
}

/* Triangles that reach beyond the others of a word, were it not for a number that is none: the word's bounds are without them. */
CASE(test_dirt)
{
    random_source r = random_named(args.seed, "dirt");
    for (size_t word = 0; word < 64; word += 7)
        for (int k = 0; k < kernels; k++) {
            const part p = {64 * word, 64};
            draw_part(&r, &p, TRIBOX_INDEX_BLOCK, here, 1);
            for (size_t i = p.first + 1; i < p.first + p.count; i += 1 + random_below(&r, 5)) {
                for (int stream = 0; stream < STORED_STREAMS; stream++)
                    stored.stream[stream][i] = here[stream / 3] + (random_int(&r, 2) ? 9.0f : -9.0f);
                spoil_triangle(&r, i);
            }
            stored_build(names[k]);
            const tribox_box about = bounds_of(p.first, p.count);
            const tribox_options options = {.kernel = names[k]};
            for (int face = 0; face < FACES; face++) {
                const float far = face < 3 ? (float)about.hi[face] : (float)about.lo[face - 3];
                const tribox_box missing = box_to(&about, face, next(far, face < 3), 3);
                expect_unseen(&missing, &options, "missed by an ulp", face, 0);
            }
            check_forms(&about, &options, "dirt");
        }
}

PROGRAM_AFTER(make_all, RUN(test_each_word), RUN(test_ends_of_range), RUN(test_nodes), RUN(test_zeros), RUN(test_dirt))
