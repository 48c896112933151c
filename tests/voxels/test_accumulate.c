/*
 * test_accumulate.c - bits are set and never cleared, the report counts the new ones, and neither parts of a soup, nor the order of
 * its triangles, nor that of their vertices changes what is EXACT.
 */
#include "occupancy.h"

#include <math.h>

#include "common/harness.h"
#include "grid_kinds.h"
#include "triangle_kinds.h"

enum { PAIRS_A_ROUND = 100000, CELLS_MAX = 8000, TRIANGLES = 200, ROUNDS = 250 };

static grid_planes at;
static triangle_list triangles, other;
static uint64_t whole[CELLS_MAX], noise[CELLS_MAX], occupied[CELLS_MAX];

static void draw_pairs(random_source *r, size_t round)
{
    draw_grid_of_kind(r, grid_kind_at(round % grid_kind_count()), CELLS_MAX, &at);
    const size_t wanted = (size_t)random_int_between(r, 1, TRIANGLES);
    for (triangles.count = 0; triangles.count < wanted;) {
        float u[3][3];
        draw_triangle(r, triangle_kind_at((size_t)random_int(r, (int)triangle_kind_count())), &at, u);
        triangle_list_put(&triangles, (const_vertices)u);
    }
}

static tribox_options any_options(random_source *r, tribox_accuracy accuracy)
{
    return (tribox_options){.accuracy = accuracy, .kernel = names[random_int(r, kernels)]};
}

static size_t ask(const tribox_soup *soup, const tribox_options *options, uint64_t *words)
{
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    assert_int_equal(tribox_voxelize(soup, &at.grid, NULL, options, words, &report), TRIBOX_OK);
    return report.overlapping;
}

static size_t ask_whole(const tribox_options *options)
{
    const tribox_soup soup = triangle_list_soup(&triangles);
    memset(whole, 0, at.words * sizeof *whole);
    return ask(&soup, options, whole);
}

/* Bits that are there stay, those past the end of a row too, and do not count. */
CASE(test_bits_stay)
{
    random_source r = random_named(args.seed, "bits stay");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        draw_pairs(&r, round);
        const tribox_options options = any_options(&r, (tribox_accuracy)(round % 2 ? 0 : random_int(&r, 3)));
        const tribox_soup soup = triangle_list_soup(&triangles);
        size_t news = 0;
        ask_whole(&options);
        for (size_t w = 0; w < at.words; w++) {
            noise[w] = random_bits(&r) & (round % 3 ? ~UINT64_C(0) : random_bits(&r) & random_bits(&r));
            occupied[w] = noise[w];
            news += (size_t)__builtin_popcountll(whole[w] & ~noise[w]);
        }
        assert_int_equal(ask(&soup, &options, occupied), news);
        for (size_t w = 0; w < at.words; w++)
            if (occupied[w] != (noise[w] | whole[w]))
                fail_msg("round %zu, word %zu: %#llx and %#llx give %#llx", round, w, (unsigned long long)noise[w],
                         (unsigned long long)whole[w], (unsigned long long)occupied[w]);
        assert_int_equal(ask(&soup, &options, occupied), 0);
        assert_int_equal(tribox_voxelize(&soup, &at.grid, NULL, &options, occupied, NULL), TRIBOX_OK);
        for (size_t w = 0; w < at.words; w++)
            assert_int_equal(occupied[w], noise[w] | whole[w]);
    }
}

CASE(test_parts)
{
    random_source r = random_named(args.seed, "parts");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        draw_pairs(&r, round);
        const tribox_options options = any_options(&r, TRIBOX_EXACT);
        const size_t set = ask_whole(&options);
        size_t sum = 0;
        memset(occupied, 0, at.words * sizeof *occupied);
        for (size_t first = 0, count; first < triangles.count; first += count) {
            count = 1 + (size_t)random_int(&r, (int)(triangles.count - first));
            const tribox_soup part = triangle_list_part(&triangles, first, count, permutations[random_int(&r, ORDERS)]);
            sum += ask(&part, &options, occupied);
        }
        assert_int_equal(sum, set);
        assert_memory_equal(occupied, whole, at.words * sizeof *occupied);
    }
}

/* The triangles in any order, each with its vertices in any order, and triangles that are not finite among them. */
CASE(test_order)
{
    random_source r = random_named(args.seed, "order");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS_A_ROUND); round++) {
        draw_pairs(&r, round);
        const tribox_options options = any_options(&r, TRIBOX_EXACT);
        const size_t set = ask_whole(&options), start = (size_t)random_int(&r, (int)triangles.count);
        other.count = 0;
        for (size_t k = 0; k < triangles.count; k++) {
            float u[3][3], v[3][3];
            const int *const vertex = permutations[random_int(&r, ORDERS)];
            triangle_list_get(&triangles, (start + triangles.count - k) % triangles.count, u);
            for (int j = 0; j < 3; j++)
                memcpy(v[j], u[vertex[j]], sizeof v[j]);
            triangle_list_put(&other, (const_vertices)v);
            if (random_int(&r, 3))
                continue;
            v[random_int(&r, 3)][random_int(&r, 3)] = random_int(&r, 2) ? NAN : random_int(&r, 2) ? INFINITY : -INFINITY;
            triangle_list_put(&other, (const_vertices)v);
        }
        const tribox_soup soup = triangle_list_soup(&other);
        memset(occupied, 0, at.words * sizeof *occupied);
        assert_int_equal(ask(&soup, &options, occupied), set);
        assert_memory_equal(occupied, whole, at.words * sizeof *occupied);
    }
}

/* Not even over the whole grid, at any accuracy and with any axes. */
CASE(test_not_finite)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    random_source r = random_named(args.seed, "not finite");
    draw_grid_of_kind(&r, grid_kind_at(3), CELLS_MAX, &at);
    for (int kernel = 0; kernel < kernels; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
                triangles.count = 0;
                for (int k = 0; k < 9 * 4 * 3; k++) {
                    float u[3][3];
                    draw_triangle(&r, triangle_kind_at((size_t)random_int(&r, 4)), &at, u);
                    u[k % 3][k / 3 % 3] = bad[k / 9 % 4];
                    triangle_list_put(&triangles, (const_vertices)u);
                }
                const tribox_options options = {.accuracy = (tribox_accuracy)accuracy, .axes = axes, .kernel = names[kernel]};
                assert_int_equal(ask_whole(&options), 0);
                assert_int_equal(occupancy_count(whole, at.words), 0);
            }
}

PROGRAM(RUN(test_bits_stay), RUN(test_parts), RUN(test_order), RUN(test_not_finite))
