/* index_words.c - words of triangles that have to be asked, as nodes cannot tell. */
#include <string.h>

#include "base/bits.h"
#include "index_question.h"
#include "mesh/mesh_input.h"

/* About a box: the kernel's answers, then what they leave undecided, all at once. */
static void answer_soup_words(tribox_question *q, const size_t *word, const size_t *full, unsigned count, uint64_t *hit)
{
    uint64_t undecided[TRIBOX_BLOCK_WORDS], any = 0;
    memset(undecided, 0, count * sizeof *undecided);
    for (unsigned k = 0, n; k < count; k += n ? n : 1) {
        n = tribox_run_of_words(word + k, full + k, count - k);
        if (n)
            tribox_pairs_walk_block(&q->pairs, &q->plan, word[k], n, hit + k, undecided + k);
    }
    for (unsigned k = 0; k < count; k++)
        any |= undecided[k];
    if (any)
        q->undecided += tribox_pairs_settle_words(&q->pairs, &q->plan, word, count, undecided, hit);
}

/* Whether all vertices are there of words that follow one another, and of the one before them, which may be read with the last. */
static bool are_readable(const tribox_question *q, size_t word, size_t words)
{
    const size_t first = 64 * (word ? word - 1 : 0), left = q->over.count - first, most = 64 * (words + 1);
    return q->over.soup || tribox_mesh_is_in_range(&q->over.mesh, q->plan.kernel, first, left < most ? left : most);
}

static bool has_vertices(const tribox_question *q, size_t i)
{
    return tribox_mesh_is_in_range(&q->over.mesh, q->plan.kernel, i, 1);
}

/* One triangle of a mesh that has changed since it was indexed, as a mesh of its own. */
static uint64_t overlaps_alone(tribox_question *q, size_t i)
{
    tribox_oriented_query turned;
    tribox_mesh one = q->over.mesh;
    uint64_t hit;
    if (one.indices) {
        one.indices = (const char *)one.indices + 3 * one.index_bytes * i;
    } else {
        one.positions = (const char *)one.positions + 3 * one.stride * i;
        one.vertices -= 3 * i;
    }
    one.count = 1;
    tribox_oriented_ask_mesh(&turned, &one, q->oriented, &q->plan);
    q->undecided += tribox_oriented_answer(&turned, 0, 1, &hit);
    return hit;
}

static void answer_one_by_one(tribox_question *q, size_t first, size_t count, uint64_t *hit)
{
    memset(hit, 0, tribox_words_of(count) * sizeof *hit);
    for (size_t i = 0; i < count; i++)
        if (has_vertices(q, first + i))
            hit[i / 64] |= overlaps_alone(q, first + i) << i % 64;
}

static void answer_oriented_words(tribox_question *q, const size_t *word, const size_t *full, unsigned count, uint64_t *hit)
{
    for (unsigned k = 0, n; k < count; k += n ? n : 1) {
        const size_t first = 64 * word[k], left = q->over.count - first;
        n = tribox_run_of_words(word + k, full + k, count - k);
        if (n && are_readable(q, word[k], n))
            q->undecided += tribox_oriented_answer(&q->turned, word[k], n, hit + k);
        else if (n)
            answer_one_by_one(q, first, left < 64 * (size_t)n ? left : 64 * (size_t)n, hit + k);
    }
}

void tribox_question_answer(tribox_question *q, const size_t *word, const size_t *full, unsigned count, uint64_t *hit)
{
    /* A survey pays in full batches alone: after them more words are likely to follow. */
    q->plan.choice.is_adaptive = q->may_choose && count == TRIBOX_BLOCK_WORDS;
    if (q->oriented)
        answer_oriented_words(q, word, full, count, hit);
    else if (q->over.soup)
        answer_soup_words(q, word, full, count, hit);
    else
        q->undecided += tribox_mesh_words_answer(&q->blocks, &q->over.mesh, word, full, count, hit);
}

bool tribox_question_any(tribox_question *q, size_t word, size_t *triangle)
{
    static const size_t not_full;
    const bool is_seen_sooner = q->over.soup && !q->oriented;
    uint64_t hit = is_seen_sooner ? tribox_question_inside(q, word, ~UINT64_C(0)) : 0;
    if (!hit)
        tribox_question_answer(q, &word, &not_full, 1, &hit);
    if (hit)
        *triangle = 64 * word + tribox_lowest_bit(hit);
    return hit;
}

uint64_t tribox_question_inside(const tribox_question *q, size_t word, uint64_t candidates)
{
    const size_t first = 64 * word, left = q->over.count - first;
    if (q->over.soup)
        return q->plan.kernel->inside(q->pairs.soup, q->pairs.box, word, candidates);
    if (left < 64)
        candidates &= (UINT64_C(1) << left) - 1;
    for (uint64_t some = are_readable(q, word, 1) ? 0 : candidates; some; some &= some - 1)
        if (!has_vertices(q, first + tribox_lowest_bit(some)))
            candidates &= ~(some & -some);
    return tribox_mesh_inside(&q->over.mesh, &q->box, first, candidates);
}
