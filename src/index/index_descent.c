/* index_descent.c - the descent from the top of an index to the words that a region can touch, and what becomes of them. */
#include "index_descent.h"

#include <string.h>

#include "base/bits.h"

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
    const size_t count = q->about->over.count;
    const size_t of_level = level ? q->levels.nodes[level - 1] : tribox_words_of(count), left = of_level - 64 * j;
    const unsigned children = left < 64 ? (unsigned)left : 64;
    tribox_touch found = tribox_question_touch(q->about, node, children);
    found.touching &= first_bits(children);
    found.inside &= there(count >> 6 * (level + 1), 64 * j);
    return found;
}

static void answer_pending(tribox_descent *q)
{
    uint64_t hit[TRIBOX_PENDING];
    tribox_question_answer(q->about, q->word, q->full, q->pending, hit);
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

/*
 * Children that lie inside answer at once. Of the others, where there are several, those come first whose middle is in the box.
 * What lies inside an oriented box is not the same on every processor: there children come in the order of their numbers.
 */
static bool any_in_node(tribox_descent *q, unsigned level, size_t j, size_t *triangle)
{
    tribox_node copy;
    const tribox_node *const node = node_at(q, level, j, &copy);
    const tribox_touch found = ask(q, level, j, node);
    const bool is_box = !q->about->oriented, is_one = !(found.touching & (found.touching - 1));
    uint64_t first = is_box ? found.inside : 0;
    if (is_box && !first && !is_one)
        first = found.touching & q->about->plan.kernel->nodes->find_centred(node, &q->about->nodes);
    for (uint64_t left = found.touching; left; first &= left) {
        const unsigned c = tribox_lowest_bit(first ? first : left);
        const size_t child = 64 * j + c;
        left &= ~(UINT64_C(1) << c);
        if (found.inside >> c & 1) {
            *triangle = 64 * (child << 6 * level);
            return true;
        }
        if (level ? any_in_node(q, level - 1, child, triangle) : tribox_question_any(q->about, child, triangle))
            return true;
    }
    return false;
}

bool tribox_descent_any(tribox_descent *q, size_t *triangle)
{
    const unsigned top = q->levels.count - 1;
    return any_in_node(q, top, 0, triangle);
}
