#include "contest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "baseline.h"
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

static bool verify_one(const contestant *one, const scene *at, const uint64_t *exact, uint64_t *mask, score *result)
{
    const size_t words = tribox_mask_words(at->soup.count);
    size_t missed = 0;
    *result = (score){0, 0, 0};
    if (one->kind == CONTESTANT_LOADS)
        return true;
    if (one->kind == CONTESTANT_BASELINE) {
        contest_run(one, at, mask);
    } else {
        tribox_report report;
        const tribox_status status = tribox_overlap(&at->soup, &at->box, &one->options, mask, &report);
        if (status)
            return stop(one, at, tribox_status_text(status));
        result->undecided = report.undecided;
    }
    for (size_t w = 0; w < words; w++) {
        result->overlapping += count_bits(mask[w]);
        result->differing += count_bits(mask[w] ^ exact[w]);
        missed += count_bits(exact[w] & ~mask[w]);
    }
    if (one->kind == CONTESTANT_KERNEL && one->options.accuracy == TRIBOX_EXACT && result->differing)
        return stop(one, at, "EXACT differs from the scalar kernel");
    if (one->kind == CONTESTANT_KERNEL && one->options.accuracy == TRIBOX_CONSERVATIVE && missed)
        return stop(one, at, "CONSERVATIVE misses an overlap");
    return true;
}

bool contest_verify(const contestant *list, size_t count, const scene *at, score *scores)
{
    const size_t words = tribox_mask_words(at->soup.count);
    const contestant reference = {.name = "scalar-exact", .kind = CONTESTANT_KERNEL, .options = {.kernel = "scalar"}};
    uint64_t *const exact = calloc(2 * words, sizeof *exact);
    if (!exact)
        return stop(&reference, at, "out of memory");
    score unused;
    bool is_right = verify_one(&reference, at, exact, exact, &unused);
    for (size_t c = 0; is_right && c < count; c++) {
        memset(exact + words, 0xff, words * sizeof *exact); /* a contestant that writes nothing is seen */
        is_right = verify_one(&list[c], at, exact, exact + words, &scores[c]);
    }
    free(exact);
    return is_right;
}
