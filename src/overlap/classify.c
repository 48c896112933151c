/* classify.c - which triangles miss a box, straddle its border and lie inside: the calls. */
#include "base/bits.h"
#include "base/environment.h"
#include "mesh/mesh_input.h"
#include "overlap_call.h"

/* Adds what is inside to the hits, and returns it; every triangle is a candidate, or those that overlap. */
static uint64_t add_inside(const tribox_overlap_call *c, size_t first, bool are_all_candidates, uint64_t *hit)
{
    const size_t left = c->count - first;
    const uint64_t present = left < 64 ? ~(~UINT64_C(0) << left) : ~UINT64_C(0), candidates = are_all_candidates ? present : *hit;
    const uint64_t inside = candidates ? tribox_call_inside(c, first, candidates) : 0;
    *hit |= inside;
    return inside;
}

/*
 * FAST may miss a triangle that is inside. So every triangle is tested for that, and what is inside overlaps. Where less than a
 * quarter overlap, testing them all costs more than EXACT, which misses none: then the next block is answered so.
 */
static tribox_report classify_blocks(tribox_overlap_call *c, uint64_t *mask, uint64_t *inside)
{
    const tribox_accuracy asked = c->plan.accuracy;
    tribox_report counts = {0, 0};
    bool is_fast = false;
    for (size_t first = 0, done; first < c->count; first += done) {
        uint64_t unasked[TRIBOX_BLOCK_WORDS], *const hit = mask ? mask + first / 64 : unasked;
        const size_t left = c->count - first;
        tribox_report of_block = {0, 0};
        size_t overlapping = 0;
        c->plan.accuracy = asked == TRIBOX_FAST && !is_fast ? TRIBOX_EXACT : asked;
        done = tribox_call_answer_block(c, first, left < TRIBOX_CALL_BLOCK ? left : TRIBOX_CALL_BLOCK, hit, &of_block);
        for (size_t w = 0; w < tribox_words_of(done); w++) {
            const uint64_t found = inside || is_fast ? add_inside(c, first + 64 * w, is_fast, &hit[w]) : 0;
            overlapping += tribox_count_bits(hit[w]);
            if (inside)
                inside[first / 64 + w] = found;
        }
        counts.overlapping += overlapping;
        counts.undecided += of_block.undecided;
        is_fast = asked == TRIBOX_FAST && overlapping > done / 4;
    }
    c->plan.accuracy = asked;
    return counts;
}

static tribox_status classify_with(tribox_overlap_call *c, tribox_codes *codes, uint64_t *mask, uint64_t *inside,
                                   tribox_report *report)
{
    tribox_report counts = {0, 0};
    if (!c->soup && !tribox_mesh_is_in_range(&c->mesh, c->plan.kernel, 0, c->count))
        return TRIBOX_BAD_VERTEX;
    const tribox_environment callers = tribox_environment_enter();
    tribox_call_start(c, codes, true);
    if (c->is_empty) {
        tribox_pairs_write_none(c->count, mask);
        tribox_pairs_write_none(c->count, inside);
    } else {
        counts = classify_blocks(c, mask, inside);
    }
    tribox_environment_leave(callers);
    tribox_call_report(c, counts, report);
    return TRIBOX_OK;
}

TRIBOX_NOINLINE tribox_status classify_coded(tribox_overlap_call *c, uint64_t *mask, uint64_t *inside, tribox_report *report)
{
    tribox_codes codes;
    return classify_with(c, &codes, mask, inside, report);
}

/* One that was checked. */
static tribox_status classify(tribox_overlap_call *c, tribox_status checked, uint64_t *mask, uint64_t *inside,
                              tribox_report *report)
{
    return checked                   ? checked
           : tribox_call_may_code(c) ? classify_coded(c, mask, inside, report)
                                     : classify_with(c, NULL, mask, inside, report);
}

tribox_status tribox_classify(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                              uint64_t *inside, tribox_report *report)
{
    tribox_overlap_call c;
    return classify(&c, tribox_call_check(&c, tribox_call_take_soup(&c, soup), box, options), mask, inside, report);
}

tribox_status tribox_mesh_classify(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                                   uint64_t *inside, tribox_report *report)
{
    tribox_overlap_call c;
    return classify(&c, tribox_call_check(&c, tribox_call_take_mesh(&c, mesh), box, options), mask, inside, report);
}
