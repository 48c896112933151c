/* verify.c - compares answers with the true one. */
#include "verify.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The masks of a verification: each of as many words. */
typedef struct masks {
    uint64_t *of_all, *of_axes; /* the truth on all axes, and on those of the contestant */
    uint64_t *answer, *before;  /* of the contestant, and of the one before it */
    unsigned axes;              /* of of_axes */
    size_t words;
} masks;

size_t score_unlike(const score *s) { return s->of_all.missed + s->of_all.untrue; }

truth truth_of_work(const timing_work *work) { return (truth){contestant_truth, work, work->words}; }

static bool fail(const contestant *one, const char *what, char wrong[VERIFY_TEXT])
{
    snprintf(wrong, VERIFY_TEXT, "%s: %s", one->name, what);
    return false;
}

static unsigned axes_of(const contestant *one) { return one->options.axes ? one->options.axes : (unsigned)TRIBOX_AXES_ALL; }

static size_t count_bits(uint64_t word) { return word ? tribox_mask_indices(&word, 64, NULL) : 0; }

static errors compare(const uint64_t *exact, const uint64_t *answer, size_t words)
{
    errors e = {0, 0};
    for (size_t w = 0; w < words; w++) {
        e.missed += count_bits(exact[w] & ~answer[w]);
        e.untrue += count_bits(answer[w] & ~exact[w]);
    }
    return e;
}

static bool are_alike(const contestant *p, const contestant *q)
{
    const bool is_same_kernel = p->options.kernel && q->options.kernel && !strcmp(p->options.kernel, q->options.kernel);
    return is_same_kernel && p->run == q->run && p->options.accuracy == q->options.accuracy && axes_of(p) == axes_of(q);
}

static bool keeps_promise(const contestant *one, const score *s, char wrong[VERIFY_TEXT])
{
    if (one->promise >= PROMISE_SUPERSET && s->of_accuracy.missed)
        return fail(one, "misses an overlap", wrong);
    if (one->promise == PROMISE_EXACT && s->of_accuracy.untrue)
        return fail(one, "reports an overlap that does not exist", wrong);
    return true;
}

static bool verify_one(const contestant *one, const contestant *before, const truth *from, masks *m, score *s,
                       char wrong[VERIFY_TEXT])
{
    const size_t bytes = m->words * sizeof *m->answer;
    tribox_report report = {0, 0};
    if (axes_of(one) != m->axes && !from->find(from->question, m->axes = axes_of(one), m->of_axes))
        return fail(one, "tribox refuses the question", wrong);
    memset(m->answer, 0xff, bytes); /* a contestant that writes nothing is seen */
    if (one->prepare)
        one->prepare(one, m->answer);
    if (!one->run(one, m->answer, &report))
        return fail(one, "tribox refuses the question", wrong);
    const uint64_t *const exact = axes_of(one) == TRIBOX_AXES_ALL ? m->of_all : m->of_axes;
    *s = (score){.overlapping = tribox_mask_indices(m->answer, 64 * m->words, NULL),
                 .undecided = report.undecided,
                 .of_accuracy = compare(exact, m->answer, m->words),
                 .of_all = compare(m->of_all, m->answer, m->words)};
    if (before && are_alike(one, before) && memcmp(m->answer, m->before, bytes) != 0)
        return fail(one, "another order of the axes changes its answer", wrong);
    uint64_t *const answer = m->answer;
    m->answer = m->before;
    m->before = answer;
    return keeps_promise(one, s, wrong);
}

bool verify(const contestant *list, size_t count, const truth *from, score *scores, char wrong[VERIFY_TEXT])
{
    const size_t words = from->words;
    uint64_t *const storage = malloc((4 * words + 1) * sizeof *storage);
    masks m = {storage, storage + words, storage + 2 * words, storage + 3 * words, TRIBOX_AXES_ALL, words};
    bool is_right = storage || fail(&list[0], "out of memory for the answers", wrong);
    if (is_right && !from->find(from->question, TRIBOX_AXES_ALL, m.of_all))
        is_right = fail(&list[0], "tribox refuses the question", wrong);
    for (size_t c = 0; is_right && c < count; c++) {
        scores[c] = (score){.overlapping = 0};
        if (list[c].promise != PROMISE_NOTHING)
            is_right = verify_one(&list[c], c ? &list[c - 1] : NULL, from, &m, &scores[c], wrong);
    }
    free(storage);
    return is_right;
}
