/*
 * oriented.c - a soup and an oriented box: moved into the frame of the box block by block, and tested there.
 *
 * The move rounds: each coordinate in the frame is off by at most `error`, known for each axis and block (kernel/frame.h). So the
 * rounded triangle misses the box enlarged by the error only if the triangle misses the box, and overlaps the box diminished by the
 * error only if the triangle overlaps the box: for a common point is a mean of the vertices, and moves no farther than they do.
 * What lies between is settled in integers from the numbers of the input (PROOFS.md 8.2).
 */
#include <float.h>
#include <string.h>

#include "bits.h"
#include "environment.h"
#include "exact/oriented.h"
#include "few.h"
#include "finite.h"
#include "pairs.h"
#include "soup.h"

/* One call. */
typedef struct question {
    const tribox_soup *soup;
    const tribox_oriented_box *box;
    tribox_plan *plan;
    uint64_t *mask;
    tribox_report counts;
} question;

static bool is_box_finite(const tribox_oriented_box *box)
{
    for (int k = 0; k < 3; k++) {
        if (!tribox_is_finite(box->center[k]) || !tribox_is_finite(box->half[k]))
            return false;
        for (int a = 0; a < 3; a++)
            if (!tribox_is_finite(box->axis[k][a]))
                return false;
    }
    return true;
}

static bool is_empty(const tribox_oriented_box *box) { return box->half[0] < 0 || box->half[1] < 0 || box->half[2] < 0; }

/*
 * The box in its frame, enlarged by the error times `sign`, which is 1, 0 or -1, and by a little more than that can round. Only
 * wild triangles have coordinates beyond the greatest float.
 */
static tribox_box box_in_frame(const question *q, const tribox_moved *moved, int sign)
{
    tribox_box box;
    for (int k = 0; k < 3; k++) {
        const double half = ((double)q->box->half[k] + sign * (double)moved->error[k]) * (1 + sign * 0x1p-22);
        box.hi[k] = half < (double)FLT_MAX ? (float)half : FLT_MAX;
        box.lo[k] = -box.hi[k];
    }
    return box;
}

static tribox_oriented_pair oriented_pair_at(const question *q, const tribox_soup *soup, size_t i)
{
    tribox_oriented_pair pair = {.box = *q->box};
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            pair.u[v][a] = tribox_soup_axis(soup, a)[v][i];
    return pair;
}

/* Whether triangle i of a soup overlaps, in integers. */
static bool overlaps_in_integers(question *q, const tribox_soup *soup, size_t i)
{
    const tribox_oriented_pair pair = oriented_pair_at(q, soup, i);
    if (!tribox_triangle_is_finite(pair.u))
        return false;
    q->counts.undecided++;
    return tribox_oriented_overlap(&pair, q->plan->axes);
}

/* Words of the frame: the lanes that certainly overlap, and in *open those for the integers. */
static void answer_exactly(const question *q, const tribox_moved *moved, const tribox_soup *soup, size_t words, uint64_t *hit,
                           uint64_t *open)
{
    tribox_plan *const plan = q->plan;
    uint64_t near[TRIBOX_MOVED_WORDS], near_open[TRIBOX_MOVED_WORDS], unused[TRIBOX_MOVED_WORDS];
    const tribox_box larger = box_in_frame(q, moved, 1), smaller = box_in_frame(q, moved, -1);
    memset(hit, 0, words * sizeof *hit);
    if (smaller.hi[0] >= 0 && smaller.hi[1] >= 0 && smaller.hi[2] >= 0)
        tribox_pairs_walk_block(&(tribox_pairs){.soup = soup, .box = &smaller, .count = soup->count}, plan, 0, words, hit, unused);
    plan->accuracy = TRIBOX_CONSERVATIVE;
    tribox_pairs_walk_block(&(tribox_pairs){.soup = soup, .box = &larger, .count = soup->count}, plan, 0, words, near, near_open);
    plan->accuracy = TRIBOX_EXACT;
    for (size_t w = 0; w < words; w++)
        open[w] = (near[w] | near_open[w]) & ~hit[w] & ~moved->apart[w];
}

/* The same where the frame's own answer will do: CONSERVATIVE about the larger box, FAST about the box, to err on both sides. */
static void answer_in_frame(question *q, const tribox_moved *moved, const tribox_soup *soup, size_t words, uint64_t *hit,
                            uint64_t *open)
{
    const tribox_box box = box_in_frame(q, moved, q->plan->accuracy == TRIBOX_CONSERVATIVE ? 1 : 0);
    const tribox_pairs pairs = {.soup = soup, .box = &box, .count = soup->count};
    tribox_pairs_walk_block(&pairs, q->plan, 0, words, hit, open);
    for (size_t w = 0; w < words; w++)
        open[w] &= ~(moved->apart[w] | moved->wild[w]);
    q->counts.undecided += tribox_pairs_settle_block(&pairs, q->plan, 0, words, open, hit);
    memset(open, 0, words * sizeof *open);
}

/* `count` triangles from `first` on, which begins a word of the mask. */
static void answer_oriented_block(question *q, size_t first, size_t count)
{
    const tribox_soup *const soup = q->soup;
    const size_t words = tribox_mask_words(count);
    tribox_moved moved;
    uint64_t hit[TRIBOX_MOVED_WORDS], open[TRIBOX_MOVED_WORDS];
    q->plan->kernel->to_frame(soup, q->box, first, count, &moved);
    const tribox_soup frame = tribox_soup_of(&moved.number[0][0], 64 * TRIBOX_MOVED_WORDS, count);
    if (q->plan->accuracy == TRIBOX_EXACT)
        answer_exactly(q, &moved, &frame, words, hit, open);
    else
        answer_in_frame(q, &moved, &frame, words, hit, open);
    for (size_t w = 0; w < words; w++) {
        hit[w] &= ~(moved.apart[w] | moved.wild[w]);
        for (uint64_t left = open[w] | moved.wild[w]; left; left &= left - 1) {
            const unsigned lane = tribox_lowest_bit(left);
            hit[w] |= (uint64_t)overlaps_in_integers(q, soup, first + 64 * w + lane) << lane;
        }
        q->counts.overlapping += tribox_count_bits(hit[w]);
        if (q->mask)
            q->mask[first / 64 + w] = hit[w];
    }
}

static void answer_oriented(question *q)
{
    const size_t most = 64 * TRIBOX_MOVED_WORDS;
    for (size_t first = 0, count; first < q->soup->count; first += count) {
        const size_t left = q->soup->count - first;
        count = left <= most ? left : most - 64; /* so that the last block has a word at least, and so a packet */
        answer_oriented_block(q, first, count);
    }
}

tribox_status tribox_overlap_oriented(const tribox_soup *soup, const tribox_oriented_box *box, const tribox_options *options,
                                      uint64_t *mask, tribox_report *report)
{
    if (!box || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    if (!is_box_finite(box))
        return TRIBOX_BAD_BOX;
    tribox_plan plan;
    const tribox_status status = tribox_plan_make(options, &plan);
    if (status)
        return status;
    if (plan.accuracy == TRIBOX_EXACT && plan.axes != TRIBOX_AXES_ALL && plan.axes != TRIBOX_AXES_BOX)
        return TRIBOX_BAD_OPTION;

    tribox_few few;
    question q = {.soup = tribox_few_triangles(soup, plan.kernel, &few), .box = box, .plan = &plan, .mask = mask};
    const tribox_environment callers = tribox_environment_enter();
    if (is_empty(box))
        tribox_pairs_write_none(soup->count, mask);
    else
        answer_oriented(&q);
    tribox_environment_leave(callers);
    tribox_plan_report(&plan, q.counts, report);
    return TRIBOX_OK;
}
