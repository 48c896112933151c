/* overlap.c - the calls about a soup and a box, or a triangle and boxes: check the input, have the pairs answered. */
#include "base/bits.h"
#include "base/box.h"
#include "base/environment.h"
#include "partial_packet.h"
#include "base/finite.h"
#include "pairs.h"
#include "base/soup.h"

/* The checks of a soup and a box, in this order. */
static tribox_status check_soup_and_box(const tribox_soup *soup, const tribox_box *box, const tribox_options *options,
                                        tribox_plan *plan)
{
    if (!box || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    if (!tribox_box_is_finite(box))
        return TRIBOX_BAD_BOX;
    return tribox_plan_make(options, plan);
}

/* Whether no pair can overlap: an empty box, or a triangle that is not finite, for which the walks would find nothing either. */
static bool is_none(const tribox_query *p)
{
    return p->soup ? tribox_box_is_empty(p->box) : !tribox_triangle_is_finite(p->triangle);
}

static void answer_pairs(const tribox_query *p, tribox_plan *plan, uint64_t *mask, tribox_report *report)
{
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    if (is_none(p))
        tribox_pairs_write_none(p->count, mask);
    else
        counts = tribox_pairs_answer(p, plan, mask);
    tribox_environment_leave(callers);
    tribox_plan_report(plan, counts, report);
}

tribox_status tribox_overlap(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                             tribox_report *report)
{
    tribox_plan plan;
    const tribox_status status = check_soup_and_box(soup, box, options, &plan);
    if (status)
        return status;
    tribox_partial_packet partial;
    const tribox_soup *const packets = tribox_pad_triangles(soup, plan.kernel, &partial);
    answer_pairs(&(tribox_query){.soup = packets, .box = box, .count = soup->count}, &plan, mask, report);
    return TRIBOX_OK;
}

#if !defined(TRIBOX_SMALL)
tribox_status tribox_overlap_boxes(const float triangle[3][3], const tribox_boxes *boxes, const tribox_options *options,
                                   uint64_t *mask, tribox_report *report)
{
    if (!triangle || !tribox_boxes_are_readable(boxes))
        return TRIBOX_BAD_ARGUMENT;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    tribox_partial_packet partial;
    const tribox_boxes *const packets = tribox_pad_boxes(boxes, plan.kernel, &partial);
    answer_pairs(&(tribox_query){.triangle = triangle, .boxes = packets, .count = boxes->count}, &plan, mask, report);
    return TRIBOX_OK;
}
#endif

/*
 * The first pair whose bit differs from that of `usual`, or the count of pairs. The first blocks are small, as they often have it.
 */
static size_t first_unlike(const tribox_query *p, tribox_plan *plan, uint64_t usual)
{
    const size_t words = tribox_words_of(p->count);
    size_t block = 1;
    for (size_t word = 0; word < words; word += block, block = block < TRIBOX_BLOCK_WORDS ? 2 * block : block) {
        uint64_t hit[TRIBOX_BLOCK_WORDS];
        block = words - word < block ? words - word : block;
        tribox_pairs_answer_block(p, plan, word, block, hit);
        for (size_t w = 0; w < block; w++)
            if (hit[w] != usual) /* past the last pair bits are zero: at the latest, the first unlike is one past it */
                return 64 * (word + w) + tribox_lowest_bit(hit[w] ^ usual);
    }
    return p->count;
}

tribox_status tribox_find(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, tribox_find_what what,
                          size_t *triangle)
{
    tribox_plan plan;
    const bool is_known = triangle && (unsigned)what <= TRIBOX_FIRST_MISS;
    const tribox_status status = is_known ? check_soup_and_box(soup, box, options, &plan) : TRIBOX_BAD_ARGUMENT;
    if (status)
        return status;
    tribox_partial_packet partial;
    const tribox_query p = {.soup = tribox_pad_triangles(soup, plan.kernel, &partial), .box = box, .count = soup->count};
    const uint64_t usual = what == TRIBOX_FIRST_HIT ? 0 : ~UINT64_C(0);
    const tribox_environment callers = tribox_environment_enter();
    *triangle = !is_none(&p) ? first_unlike(&p, &plan, usual) : usual ? 0 : soup->count;
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

/*
 * FAST may miss a triangle that is inside. So every triangle is tested for that, and what is inside overlaps. Where less than a
 * quarter overlap, testing them all costs more than EXACT, which misses none: then the next block is answered so.
 */
static tribox_report classify(const tribox_query *p, tribox_plan *plan, uint64_t *mask, uint64_t *inside)
{
    const tribox_accuracy asked = plan->accuracy;
    const size_t words = tribox_words_of(p->count);
    tribox_report counts = {0, 0};
    bool is_fast = false;
    for (size_t word = 0; word < words; word += TRIBOX_BLOCK_WORDS) {
        uint64_t unasked[TRIBOX_BLOCK_WORDS], *const hit = mask ? mask + word : unasked;
        const size_t block = words - word < TRIBOX_BLOCK_WORDS ? words - word : TRIBOX_BLOCK_WORDS;
        const size_t before = counts.overlapping;
        plan->accuracy = asked == TRIBOX_FAST && !is_fast ? TRIBOX_EXACT : asked;
        counts.undecided += tribox_pairs_answer_block(p, plan, word, block, hit);
        for (size_t w = 0; w < block; w++) {
            const uint64_t candidates = is_fast ? ~UINT64_C(0) : inside ? hit[w] : 0;
            const uint64_t found = candidates ? plan->kernel->inside(p->soup, p->box, word + w, candidates) : 0;
            hit[w] |= found;
            counts.overlapping += tribox_count_bits(hit[w]);
            if (inside)
                inside[word + w] = found;
        }
        is_fast = asked == TRIBOX_FAST && counts.overlapping - before > 16 * block;
    }
    plan->accuracy = asked;
    return counts;
}

tribox_status tribox_classify(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                              uint64_t *inside, tribox_report *report)
{
    tribox_plan plan;
    const tribox_status status = check_soup_and_box(soup, box, options, &plan);
    if (status)
        return status;
    tribox_partial_packet partial;
    const tribox_query p = {.soup = tribox_pad_triangles(soup, plan.kernel, &partial), .box = box, .count = soup->count};
    tribox_report counts = {0, 0};
    const tribox_environment callers = tribox_environment_enter();
    if (is_none(&p)) {
        tribox_pairs_write_none(soup->count, mask);
        tribox_pairs_write_none(soup->count, inside);
    } else {
        counts = classify(&p, &plan, mask, inside);
    }
    tribox_environment_leave(callers);
    tribox_plan_report(&plan, counts, report);
    return TRIBOX_OK;
}
