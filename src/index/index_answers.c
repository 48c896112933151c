/* index_answers.c - the forms of the answers of an index: what becomes of each word. */
#include <string.h>

#include "base/bits.h"
#include "index_descent.h"

/* The triangles of a word, as a list. */
static void list_word(tribox_answers *to, size_t word, uint64_t hit)
{
    const size_t count = tribox_count_bits(hit), there = to->found < to->room ? to->room - to->found : 0;
    const size_t listed = count < there ? count : there;
    const uint32_t *const ids = to->ids;
    uint32_t *const list = to->list;
    const size_t end = to->found + listed;
    for (size_t n = to->found; n < end; n++, hit &= hit - 1) {
        const size_t i = 64 * word + tribox_lowest_bit(hit);
        list[n] = ids ? ids[i] : (uint32_t)i;
    }
    to->found += count;
}

static void list_full(tribox_answers *to, size_t word, size_t words)
{
    const size_t first = 64 * word, there = to->found < to->room ? to->room - to->found : 0;
    const size_t count = 64 * words < there ? 64 * words : there;
    if (to->ids && count)
        memcpy(to->list + to->found, to->ids + first, count * sizeof *to->list);
    for (size_t i = 0; !to->ids && i < count; i++)
        to->list[to->found + i] = (uint32_t)(first + i);
    to->found += 64 * words;
}

static void put_word(tribox_answers *to, size_t word, uint64_t hit, uint64_t inside)
{
    if (to->found < to->room) {
        to->number[to->found] = (uint32_t)word;
        to->bits[to->found] = hit;
        if (to->inside)
            to->inside[to->found] = inside;
    }
    to->found++;
}

void tribox_answers_take_word(const tribox_descent *q, size_t word, uint64_t hit)
{
    tribox_answers *const to = q->to;
    uint64_t inside = 0;
    if (to->inside) { /* as in tribox_classify */
        const uint64_t candidates = q->about->plan.accuracy == TRIBOX_FAST ? ~UINT64_C(0) : hit;
        inside = candidates ? tribox_question_inside(q->about, word, candidates) : 0;
        hit |= inside;
    }
    to->overlapping += tribox_count_bits(hit);
    if (to->form == TRIBOX_MASK)
        to->mask[word] = hit;
    else if (to->form == TRIBOX_WORDS && hit)
        put_word(to, word, hit, inside);
    else if (to->form == TRIBOX_LIST)
        list_word(to, word, hit);
}

void tribox_answers_take_full(const tribox_descent *q, size_t word, size_t words)
{
    tribox_answers *const to = q->to;
    to->overlapping += 64 * words;
    if (to->form == TRIBOX_MASK)
        memset(to->mask + word, 0xFF, words * sizeof *to->mask);
    for (size_t w = 0; to->form == TRIBOX_WORDS && w < words; w++)
        put_word(to, word + w, ~UINT64_C(0), ~UINT64_C(0));
    if (to->form == TRIBOX_LIST)
        list_full(to, word, words);
}
