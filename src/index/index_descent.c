/* index_descent.c - the descent from the top of an index to the words that a box can touch, and what the kernel says of them. */
#include "index_descent.h"

#include <string.h>

#include "base/bits.h"
#include "base/soup.h"

/* Bits for the first `count` children of a node. */
static uint64_t first_bits(size_t count) { return count < 64 ? (UINT64_C(1) << count) - 1 : ~UINT64_C(0); }

/* Of the children that begin at number `first`, a bit for each of `count` in all. */
static uint64_t there(size_t count, size_t first) { return count > first ? first_bits(count - first) : 0; }

/* Node j of a level: in its place, or a copy that is aligned. */
static const tribox_node *node_at(const tribox_descent *q, unsigned level, size_t j, tribox_node *copy)
{
    const char *const place = q->nodes + (q->levels.start[level] + j) * sizeof(tribox_node);
    if ((uintptr_t)place % _Alignof(tribox_node) == 0)
        return (const tribox_node *)(const void *)place;
    memcpy(copy, place, sizeof *copy);
    return copy;
}

/*
 * Asks node j of a level. Whatever a damaged node says, children that are not there do not touch, and only those that have all
 * their triangles are inside.
 */
static tribox_touch ask(const tribox_descent *q, unsigned level, size_t j, const tribox_node *node)
{
    const tribox_nodes_kernel *const kernel = q->plan->kernel->nodes;
    const size_t of_level = level ? q->levels.nodes[level - 1] : tribox_words_of(q->pairs.count), left = of_level - 64 * j;
    const unsigned children = left < 64 ? (unsigned)left : 64;
    tribox_touch found =
        q->oriented ? kernel->touch_oriented(node, children, &q->oriented->frame) : kernel->touch(node, children, q->pairs.box);
    found.touching &= first_bits(children);
    found.inside &= there(q->pairs.count >> 6 * (level + 1), 64 * j);
    return found;
}

/* How many of the pending words from place k on have to be asked and follow one another. */
static unsigned run_at(const tribox_descent *q, unsigned k)
{
    unsigned n = 0;
    while (k + n < q->pending && !q->full[k + n] && q->word[k + n] == q->word[k] + n)
        n++;
    return n;
}

/* Asks the pending words that have to be asked. Returns whether a lane is undecided. */
static bool ask_pending(tribox_descent *q, uint64_t *hit, uint64_t *undecided)
{
    uint64_t any = 0;
    memset(undecided, 0, q->pending * sizeof *undecided);
    /* A survey pays in full batches alone: after them more words are likely to follow. */
    q->plan->choice.is_adaptive = q->may_choose && q->pending == TRIBOX_PENDING;
    for (unsigned k = 0, n; k < q->pending; k += n ? n : 1) {
        n = run_at(q, k);
        if (n && q->oriented)
            q->to->counts.undecided += tribox_oriented_answer(q->oriented, q->word[k], n, hit + k);
        else if (n)
            tribox_pairs_walk_block(&q->pairs, q->plan, q->word[k], n, hit + k, undecided + k);
    }
    for (unsigned k = 0; k < q->pending; k++)
        any |= undecided[k];
    return any;
}

static void answer_pending(tribox_descent *q)
{
    uint64_t hit[TRIBOX_PENDING], undecided[TRIBOX_PENDING];
    if (ask_pending(q, hit, undecided))
        q->to->counts.undecided += tribox_pairs_settle_words(&q->pairs, q->plan, q->word, q->pending, undecided, hit);
    for (unsigned k = 0; k < q->pending; k++) {
        if (q->full[k])
            tribox_answers_take_full(q, q->word[k], q->full[k]);
        else
            tribox_answers_take_word(q, q->word[k], hit[k]);
    }
    q->pending = 0;
}

/* Where answers go into places of their own, full words need not wait for those that come before them. */
static bool is_ordered(const tribox_descent *q) { return q->to->form == TRIBOX_WORDS || q->to->form == TRIBOX_LIST; }

static void push(tribox_descent *q, size_t word, size_t full)
{
    if (full && !is_ordered(q)) {
        tribox_answers_take_full(q, word, full);
        return;
    }
    const unsigned last = q->pending - 1;
    if (q->pending && full && q->full[last] && q->word[last] + q->full[last] == word) {
        q->full[last] += full;
        return;
    }
    if (q->pending == TRIBOX_PENDING)
        answer_pending(q);
    q->word[q->pending] = word;
    q->full[q->pending++] = full;
}

/* How many bits of a word are set from bit c on, without a gap; one at least. */
static unsigned ones_at(uint64_t bits, unsigned c)
{
    const uint64_t zeros = ~(bits >> c);
    return zeros ? tribox_lowest_bit(zeros) : 64;
}

/* Levels are few: 9 at the most below the top. */
static void visit(tribox_descent *q, unsigned level, size_t j)
{
    tribox_node copy;
    const tribox_touch found = ask(q, level, j, node_at(q, level, j, &copy));
    for (uint64_t left = found.touching; left;) {
        const unsigned c = tribox_lowest_bit(left);
        const size_t child = 64 * j + c;
        left &= left - 1;
        if (found.inside >> c & 1) {
            const unsigned n = ones_at(found.inside, c);
            push(q, child << 6 * level, (size_t)n << 6 * level);
            left &= ~(first_bits(n) << c);
        } else if (level) {
            visit(q, level - 1, child);
        } else {
            push(q, child, 0);
        }
    }
}

void tribox_descent_run(tribox_descent *q)
{
    q->pending = 0;
    visit(q, q->levels.count - 1, 0);
    answer_pending(q);
}

/* A triangle that lies wholly inside is found sooner than another. */
static bool any_in_word(tribox_descent *q, size_t word, size_t *triangle)
{
    uint64_t hit = q->plan->kernel->inside(q->pairs.soup, q->pairs.box, word, ~UINT64_C(0));
    if (!hit)
        tribox_pairs_answer_block(&q->pairs, q->plan, word, 1, &hit);
    if (hit)
        *triangle = 64 * word + tribox_lowest_bit(hit);
    return hit;
}

/* Children that lie inside answer at once. Of the others, where there are several, those come first whose middle is in the box. */
static bool any_in_node(tribox_descent *q, unsigned level, size_t j, size_t *triangle)
{
    tribox_node copy;
    const tribox_node *const node = node_at(q, level, j, &copy);
    const tribox_touch found = ask(q, level, j, node);
    if (found.inside) {
        *triangle = 64 * ((64 * j + tribox_lowest_bit(found.inside)) << 6 * level);
        return true;
    }
    const bool is_one = !(found.touching & (found.touching - 1));
    uint64_t first = is_one ? 0 : found.touching & q->plan->kernel->nodes->find_centred(node, q->pairs.box);
    for (uint64_t left = found.touching; left; first &= left) {
        const unsigned c = tribox_lowest_bit(first ? first : left);
        left &= ~(UINT64_C(1) << c);
        if (level ? any_in_node(q, level - 1, 64 * j + c, triangle) : any_in_word(q, 64 * j + c, triangle))
            return true;
    }
    return false;
}

bool tribox_descent_any(tribox_descent *q, size_t *triangle)
{
    q->plan->choice.is_adaptive = false;
    return any_in_node(q, q->levels.count - 1, 0, triangle);
}
