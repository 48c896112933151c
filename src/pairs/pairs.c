/* pairs.c - many pairs: run the kernel, settle what it left undecided. */
#include "pairs.h"

#include <string.h>

#include "base/bits.h"
#include "base/floats.h"
#include "partial_packet.h"
#include "settle.h"
#include "base/soup.h"

/* Surveys a word, so that the choice knows better. */
static void answer_by_survey(const tribox_query *p, tribox_plan *plan, size_t word, uint64_t *hit, uint64_t *undecided)
{
    tribox_seen seen;
    *hit = plan->kernel->survey[tribox_walk_kind_of(plan->accuracy)](p, word, &seen, undecided);
    tribox_choice_learn(&plan->choice, &seen, plan->accuracy);
}

/* Pairs that the walks left undecided, gathered until they fill a batch: of a soup and a box as they lie in the soup. */
typedef struct gathering {
    tribox_batch batch;
    tribox_packed packed;
    size_t pair[2 * TRIBOX_BATCH]; /* the number of each among the pairs of the call, */
    size_t lane[2 * TRIBOX_BATCH]; /* and its lane among those of the words that are settled */
    unsigned count, boxes;         /* boxes: of so many in the batch */
    bool is_packed;
} gathering;

/* Vertex v of every gathered triangle of a mesh. */
static void fill_vertex(gathering *g, const tribox_corners *corners, size_t v)
{
    for (unsigned i = 0; i < g->count; i++) {
        const size_t corner = 3 * g->pair[i] + v;
        float position[3];
        const void *const from = corners->place    ? corners->place[corner]
                                 : corners->offset ? corners->base + corners->offset[corner]
                                                   : corners->base + sizeof position * corner;
        memcpy(position, from, sizeof position);
        for (size_t a = 0; a < 3; a++)
            g->batch.number[3 * a + v][i] = position[a];
    }
}

/* Pair i of the batch in place k of each number: from its stream, or the same for all. */
static void fill_batch(gathering *g, const tribox_query *p)
{
    const float *stream[15] = {NULL};
    double constant[15] = {0};
    for (int a = 0; a < 3; a++) {
        for (int v = 0; v < 3; v++) {
            stream[3 * a + v] = p->soup ? tribox_soup_axis(p->soup, a)[v] : NULL;
            constant[3 * a + v] = p->triangle ? p->triangle[3 * v + a] : 0;
        }
        stream[9 + a] = p->boxes ? p->boxes->lo[a] : NULL;
        stream[12 + a] = p->boxes ? p->boxes->hi[a] : NULL;
        constant[9 + a] = p->box ? p->box->exact.lo[a] : 0;
        constant[12 + a] = p->box ? p->box->exact.hi[a] : 0;
    }
    for (int k = 0; k < 15; k++)
        for (unsigned i = 0; i < g->count; i++)
            g->batch.number[k][i] = stream[k] ? (double)tribox_float_at(stream[k] + g->pair[i]) : constant[k];
    for (size_t v = 0; p->corners && v < 3; v++)
        fill_vertex(g, p->corners, v);
}

/* The box of those that are packed. */
static void fill_boxes(gathering *g, const tribox_box *box, unsigned count)
{
    for (; g->boxes < count; g->boxes++)
        for (int a = 0; a < 3; a++) {
            g->batch.number[9 + a][g->boxes] = box->lo[a];
            g->batch.number[12 + a][g->boxes] = box->hi[a];
        }
}

/* The first `gone` of those gathered are done. */
static void drop_settled(gathering *g, unsigned gone)
{
    g->count -= gone;
    memmove(g->lane, g->lane + gone, g->count * sizeof *g->lane);
    for (int k = 0; g->is_packed && k < 9; k++)
        memmove(g->packed.number[k], g->packed.number[k] + gone, g->count * sizeof *g->packed.number[k]);
}

/*
 * Settles the first of what is gathered, a batch at most, and adds the pairs that overlap to the hits of their words. Returns how
 * many have finite numbers; the others overlap nothing.
 */
static size_t settle_gathered(gathering *g, const tribox_query *p, const tribox_plan *plan, uint64_t *hit)
{
    const unsigned count = g->count < TRIBOX_BATCH ? g->count : TRIBOX_BATCH;
    if (g->is_packed)
        fill_boxes(g, &p->box->exact, count);
    else
        fill_batch(g, p);
    const tribox_verdict verdict = tribox_settle_packed(&g->batch, g->is_packed ? &g->packed : NULL, count, plan);
    for (uint64_t left = verdict.overlapping; left; left &= left - 1) {
        const size_t lane = g->lane[tribox_lowest_bit(left)];
        hit[lane / 64] |= UINT64_C(1) << lane % 64;
    }
    drop_settled(g, count);
    return tribox_count_bits(verdict.finite);
}

void tribox_pairs_walk_block(const tribox_query *p, tribox_plan *plan, size_t word, size_t words, uint64_t *hit,
                             uint64_t *undecided)
{
    for (size_t done = 0, next; done < words; done += next) {
        const size_t at = word + done, left = p->count - 64 * at;
        next = p->soup ? tribox_choice_next(&plan->choice, left / 64, words - done) : words - done; /* one order for all others */
        if (next) {
            const size_t count = left < 64 * next ? left : 64 * next;
            tribox_query asked = *p;
            if (p->ties != TRIBOX_TIES_LEFT)
                asked.ties = plan->choice.ties;
            plan->kernel->walk[tribox_walk_kind_of(plan->accuracy)][plan->choice.sequence](&asked, at, count, hit + done,
                                                                                           undecided + done);
        } else {
            answer_by_survey(p, plan, at, hit + done, undecided + done);
            next = 1;
        }
    }
}

/* Whether packets of these words have so many lanes undecided, as far as some of the words tell, that packing is quicker. */
static bool have_several(const uint64_t *undecided, size_t words, unsigned lanes)
{
    enum { SEVERAL = 3, EVERY = 8 };
    size_t open = 0;
    for (size_t w = 0; w < words; w += EVERY)
        open += tribox_count_bits(undecided[w]);
    return open * lanes >= SEVERAL * 64 * ((words + EVERY - 1) / EVERY);
}

size_t tribox_pairs_settle_words(const tribox_query *p, const tribox_plan *plan, const size_t *number, size_t words,
                                 const uint64_t *undecided, uint64_t *hit)
{
    gathering g;
    size_t settled = 0;
    g.count = g.boxes = 0;
    g.is_packed = p->soup && p->box && have_several(undecided, words, plan->kernel->lanes);
    for (size_t w = 0; w < words; w++) {
        if (g.is_packed && undecided[w])
            plan->kernel->pack(p->soup, p->count, number[w], undecided[w], &g.packed, g.count);
        for (uint64_t left = undecided[w]; left; left &= left - 1) {
            const unsigned lane = tribox_lowest_bit(left);
            g.pair[g.count] = 64 * number[w] + lane;
            g.lane[g.count++] = 64 * w + lane;
            if (!g.is_packed && g.count == TRIBOX_BATCH)
                settled += settle_gathered(&g, p, plan, hit);
        }
        if (g.count >= TRIBOX_BATCH)
            settled += settle_gathered(&g, p, plan, hit);
    }
    if (g.count)
        settled += settle_gathered(&g, p, plan, hit);
    return settled;
}

size_t tribox_pairs_settle_block(const tribox_query *p, const tribox_plan *plan, size_t word, size_t words,
                                 const uint64_t *undecided, uint64_t *hit)
{
    size_t number[TRIBOX_BLOCK_WORDS];
    for (size_t w = 0; w < words; w++)
        number[w] = word + w;
    return tribox_pairs_settle_words(p, plan, number, words, undecided, hit);
}

size_t tribox_pairs_answer_block(const tribox_query *p, tribox_plan *plan, size_t word, size_t words, uint64_t *hit)
{
    uint64_t undecided[TRIBOX_BLOCK_WORDS];
    uint64_t any = 0;
    tribox_pairs_walk_block(p, plan, word, words, hit, undecided);
    for (size_t w = 0; w < words; w++)
        any |= undecided[w];
    return any ? tribox_pairs_settle_block(p, plan, word, words, undecided, hit) : 0;
}

void tribox_pairs_write_none(size_t count, uint64_t *mask)
{
    if (mask)
        memset(mask, 0, tribox_words_of(count) * sizeof *mask);
}

/* A word at most, about some of the axes. */
TRIBOX_NOINLINE void walk_word(const tribox_query *p, const tribox_plan *plan, uint64_t *hit, uint64_t *undecided)
{
    tribox_partial_packet partial;
    tribox_query padded = *p;
    if (p->soup)
        padded.soup = tribox_pad_triangles(p->soup, plan->kernel, &partial);
    if (p->boxes)
        padded.boxes = tribox_pad_boxes(p->boxes, plan->kernel, &partial);
    plan->kernel->walk[tribox_walk_kind_of(plan->accuracy)][plan->choice.sequence](&padded, 0, p->count, hit, undecided);
}

/* At most a word: what the blocks do, with less around it, as a few pairs take no longer than that. */
static tribox_report answer_word(const tribox_query *p, const tribox_plan *plan, uint64_t *mask)
{
    uint64_t hit = 0, undecided = 0;
    size_t settled = 0;
    if (!p->count)
        return (tribox_report){0, 0};
    if (!TRIBOX_WALKS_SOUPS_ALONE && plan->axes == TRIBOX_AXES_ALL && (!p->corners || p->corners->place))
        hit = plan->kernel->walk_few[tribox_walk_kind_of(plan->accuracy)](p, p->count, &undecided);
    else
        walk_word(p, plan, &hit, &undecided);
    if (undecided)
        settled = tribox_pairs_settle_block(p, plan, 0, 1, &undecided, &hit);
    if (mask)
        *mask = hit;
    return (tribox_report){tribox_count_bits(hit), settled};
}

TRIBOX_NOINLINE tribox_report answer_many(const tribox_query *p, tribox_plan *plan, uint64_t *mask)
{
    const size_t words = tribox_words_of(p->count);
    tribox_report counts = {0, 0};
    for (size_t word = 0; word < words; word += TRIBOX_BLOCK_WORDS) {
        uint64_t unasked[TRIBOX_BLOCK_WORDS], *const hit = mask ? mask + word : unasked;
        const size_t block = words - word < TRIBOX_BLOCK_WORDS ? words - word : TRIBOX_BLOCK_WORDS;
        counts.undecided += tribox_pairs_answer_block(p, plan, word, block, hit);
        for (size_t w = 0; w < block; w++)
            counts.overlapping += tribox_count_bits(hit[w]);
    }
    return counts;
}

tribox_report tribox_pairs_answer(const tribox_query *p, tribox_plan *plan, uint64_t *mask)
{
    return p->count <= 64 ? answer_word(p, plan, mask) : answer_many(p, plan, mask);
}
