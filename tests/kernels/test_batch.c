/*
 * test_batch.c - every count, every alignment, every tail: memory is left alone, and each bit is what its pair alone gets.
 *
 * All streams, the mask, the report and the one box or triangle lie between pages that cannot be touched.
 */
#include "common/fences.h"
#include "common/harness.h"
#include "drawn_pairs.h"

static drawn_numbers numbers;

/* Where things lie in their pages: at the end, or a number of floats after the start. */
enum { ACCURACIES = TRIBOX_FAST + 1, PLACES = 16 };

static struct fences {
    guarded stream[SOUP_STREAMS], one, mask, report;
} fence;

/* What each pair gets when it is asked alone. */
static uint64_t alone[KERNELS_MAX][ACCURACIES][DRAWN_WORDS];

static void ask_each_alone(const pair_list *q)
{
    memset(alone, 0, sizeof alone);
    for (int k = 0; k < kernels; k++)
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            for (size_t i = 0; i < q->count; i++) {
                const pair_list pair = pair_list_at(q, i);
                uint64_t bit;
                ask_ok(&pair, &(tribox_options){.accuracy = accuracy, .kernel = names[k]}, &bit, NULL);
                assert_true(bit < 2);
                alone[k][accuracy][i / 64] |= bit << i % 64;
            }
}

/* A lane that were a copy of another, at any distance within a vector, would show: a good part of the answers differ. */
static void assert_lanes_are_distinct(const uint64_t *mask, size_t count)
{
    for (size_t distance = 1; distance <= 64; distance++) {
        size_t differing = 0;
        for (size_t i = distance; i < count; i++)
            differing += bit_of(mask, i) != bit_of(mask, i - distance);
        assert_true(differing > count / 8);
    }
}

static void *placed(guarded g, size_t bytes, size_t offset, int place)
{
    return place == AT_END ? guarded_tail(g, bytes) : g.first + offset;
}

/* Each stream goes through all alignments, and each its own way. */
static pair_list between_guards(const pair_list *from, size_t count, int place)
{
    pair_list q = {.count = count};
    for (int s = 0; s < pair_list_streams(from); s++) {
        const size_t bytes = count * sizeof(float), offset = sizeof(float) * (size_t)((place + PLACES) * (2 * s + 1) % 16);
        guarded_read_only(fence.stream[s], false);
        float *const stream = placed(fence.stream[s], bytes, offset, place);
        memcpy(stream, from->stream[s], bytes);
        guarded_read_only(fence.stream[s], true);
        q.stream[s] = stream;
    }
    guarded_read_only(fence.one, false);
    if (from->box)
        q.box = memcpy(placed(fence.one, sizeof *q.box, sizeof(double) * (size_t)place, place), from->box, sizeof *q.box);
    else
        q.triangle = memcpy(placed(fence.one, sizeof numbers.triangle, sizeof(float) * (size_t)place, place), from->triangle,
                            sizeof numbers.triangle);
    guarded_read_only(fence.one, true);
    return q;
}

static void check_call(const pair_list *q, const tribox_options *options, const uint64_t *all, int place)
{
    const size_t words = tribox_mask_words(q->count), bytes = words * sizeof(uint64_t);
    uint64_t expected[DRAWN_WORDS] = {0};
    memcpy(expected, all, bytes);
    if (q->count % 64)
        expected[words - 1] &= ~(~UINT64_C(0) << q->count % 64);

    const fenced place_of_mask = fenced_place(fence.mask, bytes, place == AT_END ? AT_END : 8 * (place % 8));
    uint64_t *const mask = (uint64_t *)(void *)place_of_mask.at;
    tribox_report *const report = placed(fence.report, sizeof *report, 0, place);
    pair_list_text(q, options, doing);
    ask_ok(q, options, mask, report);
    assert_masks_equal(q, options, expected, mask);
    assert_nothing_beside(&place_of_mask);
    assert_report(report, expected, q->count, options->accuracy);
    if (place)
        return;
    ask_ok(q, options, NULL, report);
    assert_report(report, expected, q->count, options->accuracy);
    memset(mask, POISON, bytes);
    ask_ok(q, options, mask, NULL);
    assert_masks_equal(q, options, expected, mask);
}

static void check_count(const pair_list *all, size_t count, int place)
{
    const pair_list q = between_guards(all, count, place);
    for (int k = 0; k < kernels; k++) {
        for (tribox_accuracy accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++)
            check_call(&q, &(tribox_options){.accuracy = accuracy, .kernel = names[k]}, alone[k][accuracy], place);
        ask_ok(&q, &(tribox_options){.axes = TRIBOX_AXES_BOX, .kernel = names[k]}, NULL, NULL); /* by a copy if there are few */
    }
}

static void check_form(bool is_soup)
{
    static const size_t large[] = {4095, 4096, 4097, 4159, 8192, 10000};
    random_source r = random_named(args.seed, "batch");
    const pair_list all = draw_distinct_lanes(&r, is_soup, &numbers);
    ask_each_alone(&all);
    assert_lanes_are_distinct(alone[0][TRIBOX_EXACT], all.count);
    for (int place = AT_END; place < PLACES; place++)
        for (size_t count = 0; count <= 200; count++)
            check_count(&all, count, place);
    for (size_t k = 0; k < sizeof large / sizeof large[0]; k++)
        for (int place = AT_END; place < PLACES; place += PLACES / 2)
            check_count(&all, large[k], place);
}

CASE(test_soup) { check_form(true); }

CASE(test_boxes) { check_form(false); }

/* The count of what is not finite reads no more than its streams either. */
CASE(test_not_finite)
{
    snprintf(doing, sizeof doing, "tribox_soup_not_finite");
    random_source r = random_named(args.seed, "batch");
    const pair_list all = draw_distinct_lanes(&r, true, &numbers);
    for (size_t count = 0; count <= 200; count++)
        for (int place = AT_END; place <= 0; place++) {
            const pair_list q = between_guards(&all, count, place);
            const tribox_soup soup = pair_list_soup(&q);
            size_t first;
            assert_int_equal(tribox_soup_not_finite(&soup, &first), 0);
            assert_int_equal(first, count);
        }
}

static int make_fences(void)
{
    stream_fences_make(DRAWN_MAX, fence.stream);
    fence.one = guarded_make(sizeof numbers.triangle + 64);
    fence.mask = guarded_make(sizeof alone[0][0] + 64);
    fence.report = guarded_make(sizeof(tribox_report));
    return 0;
}

PROGRAM_AFTER(make_fences, RUN(test_soup), RUN(test_boxes), RUN(test_not_finite))
