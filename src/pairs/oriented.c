/*
 * oriented.c - triangles and an oriented box: moved into the frame of the box block by block, and tested there.
 *
 * The move rounds: each coordinate in the frame is off by at most `error` (kernel/frame.h), which is that of the triangles of a
 * block that do not reach far from the box. Those that do are asked with others of their word that reach as far, so that none has
 * the error of a neighbour that reaches farther. The rounded triangle misses the box enlarged by the error only if the triangle
 * misses the box, and overlaps the box diminished by the error only if the triangle overlaps the box: for a common point is a mean
 * of the vertices, and moves no farther than they do. What lies between is settled in integers from the numbers of the input
 * (PROOFS.md 8.2).
 */
#include <math.h>
#include <string.h>

#include "base/bits.h"
#include "base/floats.h"
#include "exact/oriented/oriented.h"
#include "oriented_words.h"
#include "pairs.h"
#include "base/soup.h"

/*
 * The box in its frame, enlarged by the error times `sign`, which is 1, 0 or -1, and by a little more than that can round; as it is
 * on an axis that has no error. Halves
 * are cut off where they reach farther from any middle than a float. False if nothing is left of it.
 */
static bool set_box_in_frame(const tribox_oriented_query *q, const tribox_moved *moved, int sign, tribox_rounded_box *rounded)
{
    tribox_box box;
    bool is_left = true;
    for (int k = 0; k < 3; k++) {
        const double error = (double)moved->error[k] + q->frame.slack[k];
        const double half = (q->box->half[k] + sign * error) * (1 + (error > 0 ? sign * 0x1p-22 : 0));
        const double reach = half < 0x1p150 ? half : 0x1p150;
        box.lo[k] = q->frame.middle[k] - reach;
        box.hi[k] = q->frame.middle[k] + reach;
        is_left = is_left && reach >= 0;
    }
    if (is_left)
        tribox_box_round(&box, q->plan->axes & TRIBOX_AXES_BOX, q->plan->accuracy == TRIBOX_FAST, rounded);
    return is_left;
}

/* Whether triangle i overlaps, in integers. Counts it where it is finite. */
static bool overlaps_in_integers(const tribox_oriented_query *q, size_t i, size_t *undecided)
{
    tribox_oriented_pair pair = {.box = *q->box};
    q->read_triangle(q, i, pair.u);
    if (!tribox_are_finite_doubles(&pair.u[0][0], 9))
        return false;
    ++*undecided;
    return tribox_oriented_overlap(&pair, q->plan->axes);
}

/* Words of the frame: the lanes that certainly overlap, and in *undecided those for the integers. */
static void answer_exactly(const tribox_oriented_query *q, const tribox_moved *moved, const tribox_soup *soup, size_t word,
                           size_t words, uint64_t *hit, uint64_t *undecided)
{
    tribox_plan *const plan = q->plan;
    uint64_t larger_hit[TRIBOX_MOVED_WORDS], larger_undecided[TRIBOX_MOVED_WORDS], unused[TRIBOX_MOVED_WORDS];
    tribox_rounded_box box;
    const tribox_query pairs = {.soup = soup, .box = &box, .count = soup->count};
    memset(hit, 0, words * sizeof *hit);
    if (set_box_in_frame(q, moved, -1, &box))
        tribox_pairs_walk_block(&pairs, plan, word, words, hit, unused);
    set_box_in_frame(q, moved, 1, &box);
    plan->accuracy = TRIBOX_CONSERVATIVE;
    tribox_pairs_walk_block(&pairs, plan, word, words, larger_hit, larger_undecided);
    plan->accuracy = TRIBOX_EXACT;
    for (size_t w = 0; w < words; w++)
        undecided[w] = (larger_hit[w] | larger_undecided[w]) & ~hit[w];
}

/*
 * The same where the frame's own answer will do: CONSERVATIVE about the larger box, FAST about the box, to err on both sides.
 * Returns how many were left to double.
 */
static size_t answer_in_frame(const tribox_oriented_query *q, const tribox_moved *moved, const tribox_soup *soup, size_t word,
                              size_t words, const uint64_t *asked, uint64_t *hit, uint64_t *undecided)
{
    tribox_rounded_box box;
    const tribox_query pairs = {.soup = soup, .box = &box, .count = soup->count};
    set_box_in_frame(q, moved, q->plan->accuracy == TRIBOX_CONSERVATIVE ? 1 : 0, &box);
    tribox_pairs_walk_block(&pairs, q->plan, word, words, hit, undecided);
    for (size_t w = 0; w < words; w++)
        undecided[w] &= asked[w];
    const size_t settled = tribox_pairs_settle_block(&pairs, q->plan, word, words, undecided, hit);
    memset(undecided, 0, words * sizeof *undecided);
    return settled;
}

/* Of words word .. word + words - 1 the lanes that are asked, all within the error. Returns how many were left to double. */
static size_t answer_lanes(const tribox_oriented_query *q, const tribox_moved *moved, const tribox_soup *soup, size_t word,
                           size_t words, const uint64_t *asked, uint64_t *hit, uint64_t *undecided)
{
    size_t settled = 0;
    if (q->plan->accuracy == TRIBOX_EXACT)
        answer_exactly(q, moved, soup, word, words, hit, undecided);
    else
        settled = answer_in_frame(q, moved, soup, word, words, asked, hit, undecided);
    for (size_t w = 0; w < words; w++) {
        hit[w] &= asked[w];
        undecided[w] &= asked[w];
    }
    return settled;
}

/* How far a triangle of the block reaches from the center of the frame on an axis of space, of those that are moved. */
static float reach_of(const tribox_oriented_query *q, const tribox_soup *block, size_t i)
{
    float most = 0;
    for (int k = 0; k < 9; k++) {
        const float distance = fabsf(tribox_soup_axis(block, k / 3)[k % 3][i] - q->frame.center[k / 3]);
        most = distance > most && q->frame.near[k / 3] < INFINITY ? distance : most;
    }
    return most;
}

/* Of far lanes of a word those that reach no farther than four times the least of them, and the error of all of these. */
static uint64_t take_alike(const tribox_oriented_query *q, tribox_moved *moved, const tribox_soup *block, size_t word)
{
    float reach[64], least = INFINITY, most = 0;
    uint64_t alike = 0;
    for (uint64_t left = moved->far[word]; left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        reach[lane] = reach_of(q, block, 64 * word + lane);
        least = reach[lane] < least ? reach[lane] : least;
    }
    for (uint64_t left = moved->far[word]; left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        const bool is_alike = reach[lane] <= 4 * least;
        alike |= (uint64_t)is_alike << lane;
        most = is_alike && reach[lane] > most ? reach[lane] : most;
    }
    for (int k = 0; k < 3; k++)
        moved->error[k] = tribox_frame_error(&q->frame, k, most);
    moved->far[word] &= ~alike;
    return alike;
}

/* Whether the larger and the smaller box are so unlike that both together hardly decide anything. */
static bool is_blurred(const tribox_oriented_query *q, const tribox_moved *moved)
{
    const double *const half = q->box->half;
    const double most = half[0] > half[1] ? half[0] > half[2] ? half[0] : half[2] : half[1] > half[2] ? half[1] : half[2];
    bool is = false;
    for (int k = 0; k < 3; k++)
        is |= (double)moved->error[k] > most / 256;
    return is;
}

/* The words of a block: those that are not far together, then the others, word by word. FAST has no error, and asks all at once. */
static size_t answer_moved(const tribox_oriented_query *q, const tribox_soup *block, tribox_moved *moved, const tribox_soup *soup,
                           size_t words, uint64_t *hit, uint64_t *undecided)
{
    uint64_t near[TRIBOX_MOVED_WORDS] = {0};
    for (size_t w = 0; w < words; w++) {
        moved->far[w] = q->plan->accuracy == TRIBOX_FAST ? 0 : moved->far[w];
        near[w] = ~(moved->apart[w] | moved->wild[w] | moved->far[w]);
    }
    size_t settled = answer_lanes(q, moved, soup, 0, words, near, hit, undecided);
    for (size_t w = 0; w < words; w++)
        while (moved->far[w]) {
            const uint64_t alike = take_alike(q, moved, block, w);
            uint64_t found = 0, left = alike;
            if (q->plan->accuracy != TRIBOX_EXACT || !is_blurred(q, moved))
                settled += answer_lanes(q, moved, soup, w, 1, &alike, &found, &left);
            hit[w] |= found;
            undecided[w] |= left;
        }
    return settled;
}

/*
 * Triangles first .. first + count - 1, at most TRIBOX_MOVED_WORDS words, and a whole packet at least. Nothing is asked about the
 * first `unasked` words.
 */
static size_t answer_oriented_block(const tribox_oriented_query *q, size_t first, size_t count, size_t unasked, uint64_t *hit)
{
    const size_t words = tribox_words_of(count);
    tribox_streams room;
    tribox_moved moved;
    uint64_t undecided[TRIBOX_MOVED_WORDS];
    const tribox_soup block = q->read_block(q, first, count, &room);
    q->plan->kernel->to_frame(&block, &q->frame, 0, count, &moved);
    for (size_t w = 0; w < unasked; w++) {
        moved.apart[w] = ~UINT64_C(0);
        moved.wild[w] = moved.far[w] = 0;
    }
    const tribox_soup frame = tribox_soup_of(&moved.number[0][0], 64 * TRIBOX_MOVED_WORDS, count);
    size_t settled = answer_moved(q, &block, &moved, &frame, words, hit, undecided);
    for (size_t w = 0; w < words; w++)
        for (uint64_t left = undecided[w] | moved.wild[w]; left; left &= left - 1) {
            const unsigned lane = tribox_lowest_bit(left);
            hit[w] |= (uint64_t)overlaps_in_integers(q, first + 64 * w + lane, &settled) << lane;
        }
    return settled;
}

/* The last triangles, where they fill no packet: with the word before them. */
static size_t answer_last(const tribox_oriented_query *q, size_t first, uint64_t *hit)
{
    uint64_t both[2];
    const size_t undecided = answer_oriented_block(q, first - 64, q->count - (first - 64), 1, both);
    *hit = both[1];
    return undecided;
}

size_t tribox_oriented_answer(const tribox_oriented_query *q, size_t word, size_t words, uint64_t *hit)
{
    size_t undecided = 0;
    for (size_t done = 0; done < words; done += TRIBOX_MOVED_WORDS) {
        const size_t block = words - done < TRIBOX_MOVED_WORDS ? words - done : TRIBOX_MOVED_WORDS;
        const size_t first = 64 * (word + done), left = q->count - first;
        if (first && left < q->plan->kernel->lanes)
            undecided += answer_last(q, first, hit + done);
        else
            undecided += answer_oriented_block(q, first, left < 64 * block ? left : 64 * block, 0, hit + done);
    }
    return undecided;
}

tribox_report tribox_oriented_answer_all(const tribox_oriented_query *q, uint64_t *mask)
{
    const size_t words = tribox_words_of(q->count);
    tribox_report counts = {0, 0};
    for (size_t word = 0; word < words; word += TRIBOX_MOVED_WORDS) {
        uint64_t unasked[TRIBOX_MOVED_WORDS], *const hit = mask ? mask + word : unasked;
        const size_t block = words - word < TRIBOX_MOVED_WORDS ? words - word : TRIBOX_MOVED_WORDS;
        counts.undecided += tribox_oriented_answer(q, word, block, hit);
        for (size_t w = 0; w < block; w++)
            counts.overlapping += tribox_count_bits(hit[w]);
    }
    return counts;
}

static tribox_soup soup_block(const tribox_oriented_query *q, size_t first, size_t count, tribox_streams *room)
{
    const tribox_soup *const soup = q->triangles;
    tribox_soup block = {.count = count};
    (void)room;
    for (int v = 0; v < 3; v++) {
        block.x[v] = soup->x[v] + first;
        block.y[v] = soup->y[v] + first;
        block.z[v] = soup->z[v] + first;
    }
    return block;
}

static void soup_triangle(const tribox_oriented_query *q, size_t i, double u[3][3])
{
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++)
            u[v][a] = (double)tribox_float_at(tribox_soup_axis(q->triangles, a)[v] + i);
}

void tribox_oriented_ask_soup(tribox_oriented_query *q, const tribox_soup *soup, const tribox_oriented_box *box, tribox_plan *plan)
{
    *q = (tribox_oriented_query){.box = box,
                                 .plan = plan,
                                 .triangles = soup,
                                 .count = soup->count,
                                 .read_block = soup_block,
                                 .read_triangle = soup_triangle};
    tribox_frame_round(box, NULL, false, &q->frame);
}
