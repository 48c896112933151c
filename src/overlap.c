/* overlap.c - many pairs: check the input, run the kernel, settle what it left open. */
#include <string.h>

#include "bits.h"
#include "environment.h"
#include "exact.h"
#include "finite.h"
#include "plan.h"
#include "settle.h"
#include "soup.h"

/* Words that a kernel answers at a time, so that what it leaves open is settled while its triangles are in the cache. */
enum { BLOCK_WORDS = 64 };

size_t tribox_mask_words(size_t count) { return count / 64 + (count % 64 != 0); }

/* The pairs of a call: a soup and a box, or a triangle and boxes. */
typedef struct pairs {
    const tribox_soup *soup; /* NULL for a triangle and boxes */
    const tribox_box *box;
    const float (*triangle)[3];
    const tribox_boxes *boxes;
    size_t count;
} pairs;

/* So many pairs from 64 * word, a multiple of TRIBOX_LANES_MOST. */
static void walk(const pairs *p, const tribox_plan *plan, size_t word, size_t count, uint64_t *hit, uint64_t *open)
{
    if (p->soup)
        plan->kernel->soup[plan->accuracy][plan->sequence](p->soup, p->box, word, count, hit, open);
    else
        plan->kernel->boxes[plan->accuracy][plan->sequence](p->triangle, p->boxes, word, count, hit, open);
}

/* The last count % 64 pairs, in a word of their own with zeros up to a packet: nothing is read past the caller's streams. */
static void walk_tail(const pairs *p, const tribox_plan *plan, uint64_t *hit, uint64_t *open)
{
    const size_t tail = p->count % 64, first = p->count - tail,
                 lanes = (tail + TRIBOX_LANES_MOST - 1) & ~(size_t)(TRIBOX_LANES_MOST - 1);
    float scratch[9][64];
    tribox_soup soup;
    tribox_boxes boxes = {.count = 64};
    for (int k = 0; k < 9; k++)
        memset(scratch[k] + tail, 0, (lanes - tail) * sizeof(float));
    if (p->soup)
        soup = tribox_soup_tail(p->soup, scratch);
    for (int a = 0; !p->soup && a < 3; a++) {
        boxes.lo[a] = memcpy(scratch[a], p->boxes->lo[a] + first, tail * sizeof(float));
        boxes.hi[a] = memcpy(scratch[3 + a], p->boxes->hi[a] + first, tail * sizeof(float));
    }
    pairs word = *p;
    word.soup = p->soup ? &soup : NULL;
    word.boxes = p->soup ? NULL : &boxes;
    walk(&word, plan, 0, lanes, hit, open);
    *hit &= ~(~UINT64_C(0) << tail);
    *open &= ~(~UINT64_C(0) << tail);
}

/* Pairs that the walks left open, gathered until they fill a batch. */
typedef struct gathering {
    tribox_batch batch;
    size_t lane[TRIBOX_BATCH]; /* of pair i of the batch, counted from the start of the block */
    unsigned count;
} gathering;

/* One number of every gathered pair, from a stream or the same for all. */
static void fill_number(gathering *g, int k, const float *stream, float constant)
{
    float *const number = g->batch.number[k];
    for (unsigned i = 0; i < g->count; i++)
        number[i] = stream ? stream[g->lane[i]] : constant;
}

static void fill(gathering *g, const pairs *p, size_t start)
{
    for (int a = 0; a < 3; a++) {
        for (int v = 0; v < 3; v++) {
            const float *const *const streams = !p->soup ? NULL : a == 0 ? p->soup->x : a == 1 ? p->soup->y : p->soup->z;
            fill_number(g, 3 * v + a, streams ? streams[v] + start : NULL, streams ? 0 : p->triangle[v][a]);
        }
        fill_number(g, 9 + a, p->soup ? NULL : p->boxes->lo[a] + start, p->soup ? p->box->lo[a] : 0);
        fill_number(g, 12 + a, p->soup ? NULL : p->boxes->hi[a] + start, p->soup ? p->box->hi[a] : 0);
    }
}

/* Which of the gathered triangles are finite: adding one to an exponent of all ones turns the sign bit. */
static uint64_t finite_pairs(const gathering *g)
{
    uint32_t turned[TRIBOX_BATCH] = {0};
    for (int k = 0; k < 9; k++) {
        uint32_t bits[TRIBOX_BATCH];
        memcpy(bits, g->batch.number[k], g->count * sizeof *bits);
        for (unsigned i = 0; i < g->count; i++)
            turned[i] |= (bits[i] & 0x7fffffffu) + 0x00800000u;
    }
    uint64_t finite = 0;
    for (unsigned i = 0; i < g->count; i++)
        finite |= (uint64_t)(~turned[i] >> 31) << i;
    return finite;
}

/*
 * Settles what is gathered, and adds those that overlap to the hits of the block. Returns how many there were with finite numbers.
 * What the others come to is ignored.
 */
static size_t settle(gathering *g, const pairs *p, const tribox_plan *plan, size_t start, uint64_t *hit)
{
    fill(g, p, start);
    const uint64_t finite = finite_pairs(g);
    for (uint64_t left = tribox_settle_batch(&g->batch, g->count, finite, plan); left; left &= left - 1) {
        const size_t lane = g->lane[tribox_lowest_bit(left)];
        hit[lane / 64] |= UINT64_C(1) << lane % 64;
    }
    g->count = 0;
    return tribox_count_bits(finite);
}

/* Settles the open lanes of a block and adds those that overlap to its hits. Returns how many there were with finite numbers. */
static size_t settle_block(const pairs *p, const tribox_plan *plan, size_t word, size_t words, const uint64_t *open, uint64_t *hit)
{
    gathering g;
    size_t undecided = 0;
    g.count = 0;
    for (size_t w = 0; w < words; w++)
        for (uint64_t rest = open[w]; rest; rest &= rest - 1) {
            g.lane[g.count++] = 64 * w + tribox_lowest_bit(rest);
            if (g.count == TRIBOX_BATCH)
                undecided += settle(&g, p, plan, 64 * word, hit);
        }
    return g.count ? undecided + settle(&g, p, plan, 64 * word, hit) : undecided;
}

static void answer(const pairs *p, const tribox_plan *plan, uint64_t *mask, tribox_report *report)
{
    const size_t words = tribox_mask_words(p->count);
    tribox_report counts = {0, 0};
    for (size_t word = 0; word < words; word += BLOCK_WORDS) {
        uint64_t hit[BLOCK_WORDS], open[BLOCK_WORDS];
        const size_t block = words - word < BLOCK_WORDS ? words - word : BLOCK_WORDS;
        const size_t whole = word + block <= p->count / 64 ? block : block - 1;
        walk(p, plan, word, 64 * whole, hit, open);
        if (whole < block)
            walk_tail(p, plan, hit + whole, open + whole);
        counts.undecided += settle_block(p, plan, word, block, open, hit);
        for (size_t w = 0; w < block; w++)
            counts.overlapping += tribox_count_bits(hit[w]);
        if (mask)
            memcpy(mask + word, hit, block * sizeof *mask);
    }
    if (plan->accuracy == TRIBOX_FAST)
        counts.undecided = 0;
    if (report)
        *report = counts;
}

static void answer_none(size_t count, uint64_t *mask, tribox_report *report)
{
    if (mask)
        memset(mask, 0, tribox_mask_words(count) * sizeof *mask);
    if (report)
        *report = (tribox_report){0, 0};
}

tribox_status tribox_overlap(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, uint64_t *mask,
                             tribox_report *report)
{
    if (!box || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    for (int a = 0; a < 3; a++)
        if (!tribox_is_finite(box->lo[a]) || !tribox_is_finite(box->hi[a]))
            return TRIBOX_BAD_BOX;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;

    const tribox_environment callers = tribox_environment_enter();
    if (box->lo[0] > box->hi[0] || box->lo[1] > box->hi[1] || box->lo[2] > box->hi[2])
        answer_none(soup->count, mask, report);
    else
        answer(&(pairs){.soup = soup, .box = box, .count = soup->count}, &plan, mask, report);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

tribox_status tribox_overlap_boxes(const float triangle[3][3], const tribox_boxes *boxes, const tribox_options *options,
                                   uint64_t *mask, tribox_report *report)
{
    if (!triangle || !boxes || !tribox_is_addressable(boxes->count))
        return TRIBOX_BAD_ARGUMENT;
    for (int a = 0; boxes->count && a < 3; a++)
        if (!boxes->lo[a] || !boxes->hi[a])
            return TRIBOX_BAD_ARGUMENT;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;

    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_triangle_is_finite(triangle))
        answer_none(boxes->count, mask, report);
    else
        answer(&(pairs){.triangle = triangle, .boxes = boxes, .count = boxes->count}, &plan, mask, report);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

const char *tribox_status_text(tribox_status status)
{
    switch (status) {
    case TRIBOX_OK:
        return "success";
    case TRIBOX_BAD_ARGUMENT:
        return "a required pointer is NULL, or a count exceeds the address space";
    case TRIBOX_BAD_BOX:
        return "a bound of the box is NaN or infinite";
    case TRIBOX_BAD_GRID:
        return "the grid is not finite, not positive, too large, or too fine for float";
    case TRIBOX_BAD_OPTION:
        return "unknown accuracy, axis set or order of the axes";
    case TRIBOX_NO_KERNEL:
        return "unknown kernel name, or a kernel that this processor cannot run";
    case TRIBOX_NO_MEMORY:
        return "out of memory";
    }
    return "unknown status";
}
