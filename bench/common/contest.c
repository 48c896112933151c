#include "contest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "paper/baseline.h"
#include "loads.h"

static const char *const kernel_names[] = {"avx512", "avx2", "sse2", "neon", "scalar"};

static const struct {
    const char *name;
    tribox_accuracy accuracy;
} accuracies[] = {{"fast", TRIBOX_FAST}, {"conservative", TRIBOX_CONSERVATIVE}, {"exact", TRIBOX_EXACT}};

size_t contest_enter(contestant list[CONTESTANTS_MAX])
{
    size_t count = 0;
    list[count++] = (contestant){.name = "baseline", .kind = CONTESTANT_BASELINE};
    list[count++] = (contestant){.name = "loads", .kind = CONTESTANT_LOADS};
    for (size_t k = 0; k < sizeof kernel_names / sizeof kernel_names[0]; k++)
        for (size_t a = 0; a < sizeof accuracies / sizeof accuracies[0]; a++) {
            contestant one = {.kind = CONTESTANT_KERNEL,
                              .options = {.accuracy = accuracies[a].accuracy, .kernel = kernel_names[k]}};
            snprintf(one.name, sizeof one.name, "%s-%s", kernel_names[k], accuracies[a].name);
            if (tribox_kernel_name(&one.options))
                list[count++] = one;
        }
    return count;
}

size_t contest_fast_of(const contestant *list, size_t count, size_t c)
{
    const contestant *const one = &list[c];
    for (size_t f = 0; one->kind == CONTESTANT_KERNEL && f < count; f++) {
        const contestant *const other = &list[f];
        if (other->kind == CONTESTANT_KERNEL && other->options.accuracy == TRIBOX_FAST &&
            other->options.axes == one->options.axes && !strcmp(one->options.kernel, other->options.kernel))
            return f;
    }
    return c;
}

void contest_run(const contestant *one, const scene *at, uint64_t *mask)
{
    switch (one->kind) {
    case CONTESTANT_BASELINE:
        baseline_overlap_soup(at->center, at->half, at->triangles, at->soup.count, mask);
        break;
    case CONTESTANT_LOADS:
        mask[0] = loads_all(&at->soup);
        break;
    case CONTESTANT_KERNEL:
        tribox_overlap(&at->soup, &at->box, &one->options, mask, NULL);
        break;
    case CONTESTANT_PEER:
        one->run(one->peer, at, mask);
        break;
    }
}

static size_t count_bits(uint64_t word)
{
    size_t bits = 0;
    for (; word; word &= word - 1)
        bits++;
    return bits;
}

static bool stop(const contestant *one, const scene *at, const char *what)
{
    fprintf(stderr, "bench: %s on scene %s: %s; nothing is timed\n", one->name, at->name, what);
    return false;
}

static errors compare(const uint64_t *truth, const uint64_t *told, size_t words)
{
    errors e = {0, 0};
    for (size_t w = 0; w < words; w++) {
        e.missed += count_bits(truth[w] & ~told[w]);
        e.untrue += count_bits(told[w] & ~truth[w]);
    }
    return e;
}

static unsigned axes_of(const contestant *one) { return one->options.axes ? one->options.axes : (unsigned)TRIBOX_AXES_ALL; }

/* The scalar kernel at EXACT. */
static bool find_truth(unsigned axes, const scene *at, uint64_t *mask)
{
    const contestant reference = {.name = "scalar-exact", .options = {.kernel = "scalar", .axes = axes}};
    const tribox_status status = tribox_overlap(&at->soup, &at->box, &reference.options, mask, NULL);
    return status ? stop(&reference, at, tribox_status_text(status)) : true;
}

static bool answer(const contestant *one, const scene *at, uint64_t *mask, score *s)
{
    tribox_report report = {0, 0};
    tribox_status status = TRIBOX_OK;
    if (one->kind == CONTESTANT_KERNEL)
        status = tribox_overlap(&at->soup, &at->box, &one->options, mask, &report);
    else
        contest_run(one, at, mask);
    s->undecided = report.undecided;
    return status ? stop(one, at, tribox_status_text(status)) : true;
}

/* The masks: the truth on all axes, on the contestant's axes, and room for its answer. */
static bool verify_one(const contestant *one, const scene *at, uint64_t *const masks[3], score *s)
{
    const size_t words = tribox_mask_words(at->soup.count);
    *s = (score){.overlapping = 0};
    if (one->kind == CONTESTANT_LOADS)
        return true;
    memset(masks[2], 0xff, words * sizeof(uint64_t)); /* a contestant that writes nothing is seen */
    if (!answer(one, at, masks[2], s))
        return false;
    for (size_t w = 0; w < words; w++)
        s->overlapping += count_bits(masks[2][w]);
    s->of_all = compare(masks[0], masks[2], words);
    s->of_accuracy = compare(masks[1], masks[2], words);
    if (one->kind != CONTESTANT_KERNEL)
        return true;
    if (one->options.accuracy == TRIBOX_EXACT && s->of_accuracy.missed + s->of_accuracy.untrue)
        return stop(one, at, "EXACT differs from the scalar kernel");
    if (one->options.accuracy == TRIBOX_CONSERVATIVE && s->of_accuracy.missed)
        return stop(one, at, "CONSERVATIVE misses an overlap");
    return true;
}

bool contest_verify(const contestant *list, size_t count, const scene *at, score *scores)
{
    const size_t words = tribox_mask_words(at->soup.count);
    uint64_t *const storage = calloc(3 * words, sizeof *storage), *const masks[3] = {storage, storage + words, storage + 2 * words};
    if (!storage)
        return stop(&list[0], at, "out of memory");
    bool is_right = find_truth(TRIBOX_AXES_ALL, at, masks[0]);
    unsigned axes = 0;
    for (size_t c = 0; is_right && c < count; c++) {
        if (axes_of(&list[c]) != axes) {
            axes = axes_of(&list[c]);
            is_right = find_truth(axes, at, masks[1]);
        }
        is_right = is_right && verify_one(&list[c], at, masks, &scores[c]);
    }
    free(storage);
    return is_right;
}
