/* test_parity.c - kernels, orders and accuracies agree where they have to: EXACT everywhere, FAST among equal roundings. */
#include <math.h>

#include "common/fences.h"
#include "common/harness.h"
#include "drawn_pairs.h"

static drawn_numbers numbers;

enum { ACCURACIES = TRIBOX_FAST + 1, WORDS = (SCENE_TRIANGLES + 63) / 64 };

/* One set of axes, default order: the mask of each kernel and accuracy. */
typedef struct answers {
    uint64_t mask[KERNELS_MAX][ACCURACIES][WORDS];
} answers;

static void ask(const pair_list *q, const tribox_options *options, uint64_t *mask)
{
    tribox_report report;
    pair_list_text(q, options, doing);
    ask_ok(q, options, mask, &report);
    assert_report(&report, mask, q->count, options->accuracy);
}

static void ask_kernels(const pair_list *q, unsigned axes, answers *got)
{
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            ask(q, &(tribox_options){.accuracy = accuracy, .axes = axes, .axis_order = 0, .kernel = names[k]},
                got->mask[k][accuracy]);
}

static void check_orders(const pair_list *q, unsigned axes, const answers *got)
{
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (int o = 1; o < AXIS_ORDERS; o++) {
                const tribox_options options = {
                    .accuracy = accuracy, .axes = axes, .axis_order = axis_order_at(o), .kernel = names[k]};
                uint64_t mask[WORDS];
                ask(q, &options, mask);
                assert_masks_equal(q, &options, got->mask[k][accuracy], mask);
            }
}

/* FAST promises something for |coordinate| <= 2^40; beyond, products overflow, and what a NaN comes to depends on the kernel. */
static bool is_in_fast_range(const pair_list *q, size_t i)
{
    float largest = 0;
    for (int k = 0; k < (q->box ? 9 : 6); k++)
        largest = fmaxf(largest, fabsf(q->stream[k][i]));
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < (q->box ? 2 : 3); k++)
            largest = fmaxf(largest, fabsf(!q->box ? q->triangle[k][a] : k ? (float)q->box->hi[a] : (float)q->box->lo[a]));
    return largest <= 0x1p40f;
}

static void assert_fast_masks_equal(const pair_list *q, const tribox_options *options, const uint64_t *expected,
                                    const uint64_t *mask)
{
    uint64_t kept[2][WORDS] = {{0}};
    for (size_t i = 0; i < q->count; i++)
        if (is_in_fast_range(q, i)) {
            kept[0][i / 64] |= (uint64_t)bit_of(expected, i) << i % 64;
            kept[1][i / 64] |= (uint64_t)bit_of(mask, i) << i % 64;
        }
    assert_masks_equal(q, options, kept[0], kept[1]);
}

/* EXACT: what the scalar kernel says, which is the first. FAST: what the first kernel of the same rounding says. */
static void check_kernels(const pair_list *q, unsigned axes, const answers *got)
{
    for (int k = 1; k < kernels; k++) {
        size_t peer = 0;
        while (kernel_is_fused(names[peer]) != kernel_is_fused(names[k]))
            peer++;
        assert_masks_equal(q, &(tribox_options){.accuracy = TRIBOX_EXACT, .axes = axes, .axis_order = 0, .kernel = names[k]},
                           got->mask[0][TRIBOX_EXACT], got->mask[k][TRIBOX_EXACT]);
        assert_fast_masks_equal(q, &(tribox_options){.accuracy = TRIBOX_FAST, .axes = axes, .axis_order = 0, .kernel = names[k]},
                                got->mask[peer][TRIBOX_FAST], got->mask[k][TRIBOX_FAST]);
    }
}

/* What a pair gets does not depend on its neighbours. */
static void check_alone(const pair_list *q, unsigned axes, const answers *got)
{
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (size_t i = 0; i < q->count; i++) {
                const tribox_options options = {.accuracy = accuracy, .axes = axes, .axis_order = 0, .kernel = names[k]};
                const pair_list pair = pair_list_at(q, i);
                uint64_t bit;
                ask(&pair, &options, &bit);
                if (bit != bit_of(got->mask[k][accuracy], i))
                    fail_at_pair(q, &options, i, bit);
            }
}

static void check_conservative(const pair_list *q, unsigned axes, const answers *got)
{
    for (int k = 0; k < kernels; k++)
        for (size_t i = 0; i < q->count; i++)
            if (bit_of(got->mask[k][TRIBOX_EXACT], i) && !bit_of(got->mask[k][TRIBOX_CONSERVATIVE], i))
                fail_at_pair(q,
                             &(tribox_options){.accuracy = TRIBOX_CONSERVATIVE, .axes = axes, .axis_order = 0, .kernel = names[k]},
                             i, true);
}

/* What is left out of the axes can only add overlaps. */
static void check_more_axes(const pair_list *q, const answers *all, unsigned axes, const answers *some)
{
    for (size_t i = 0; i < q->count; i++)
        if (bit_of(all->mask[0][TRIBOX_EXACT], i) && !bit_of(some->mask[0][TRIBOX_EXACT], i))
            fail_at_pair(q, &(tribox_options){.accuracy = TRIBOX_EXACT, .axes = axes, .axis_order = 0, .kernel = names[0]}, i,
                         true);
}

static void check_question(const pair_list *q, size_t *overlapping)
{
    answers all = {{{{0}}}};
    ask_kernels(q, TRIBOX_AXES_ALL, &all);
    *overlapping += bits_set(all.mask[0][TRIBOX_EXACT], tribox_mask_words(q->count));
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        answers got = {{{{0}}}};
        ask_kernels(q, axes, &got);
        check_kernels(q, axes, &got);
        check_orders(q, axes, &got);
        check_conservative(q, axes, &got);
        check_alone(q, axes, &got);
        check_more_axes(q, &all, axes, &got);
    }
}

/* Agreement on scenes that all miss, or all hit, would be worth little. */
static void check_scenes(bool is_soup)
{
    const size_t rounds = arguments_rounds(&args, 50000);
    size_t asked = 0, overlapping = 0;
    for (size_t i = 0; i < scene_count(); i++) {
        const scene *const s = scene_at(i);
        random_source r = random_named(args.seed, s->name);
        for (size_t round = 0; scene_is_called(s, args.scenes) && round < rounds; round++) {
            const pair_list q = draw_pairs(&r, s, is_soup, &numbers);
            check_question(&q, &overlapping);
            asked += q.count;
        }
    }
    print_message("%zu pairs, of which %zu overlap\n", asked, overlapping);
    assert_in_range(overlapping, asked / 10, asked - asked / 10);
}

CASE(test_soup) { check_scenes(true); }

CASE(test_boxes) { check_scenes(false); }

/* Far from the box but for its end: what margins leave undecided first may lie in a packet that is not full. */
CASE(test_ends)
{
    random_source r = random_named(args.seed, "ends");
    for (size_t round = 0; round < arguments_rounds(&args, 200); round++) {
        pair_list q = draw_pairs(&r, &(scene){.name = "ends", .draw = draw_near_contact}, true, &numbers);
        answers got = {{{{0}}}};
        q.count -= (size_t)random_int(&r, 64);
        const size_t far = q.count - (size_t)random_int(&r, 16);
        for (size_t i = 0; i < far; i++)
            numbers.stream[0][i] = numbers.stream[1][i] = numbers.stream[2][i] = 0x1p20f;
        ask_kernels(&q, TRIBOX_AXES_ALL, &got);
        check_kernels(&q, TRIBOX_AXES_ALL, &got);
    }
}

static int check_name(void) { return scene_name_is_known(args.scenes) ? 0 : 2; }

PROGRAM_AFTER(check_name, RUN(test_soup), RUN(test_boxes), RUN(test_ends))
