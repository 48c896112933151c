/* fuzz_soup.c - what else is asked of a soup and a box, or of a mask: any, all, inside, the list of bits, what is not finite. */
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "tight_memory.h"
#include "target.h"

typedef struct fuzz_case {
    asked asked;
    tribox_soup soup;
    tribox_box box;
    uint64_t inside[COUNT_MAX / 64 + 1]; /* which triangles are inside */
} fuzz_case;

/* By comparison of every coordinate with the bounds. */
static bool is_inside(const float u[3][3], const tribox_box *box)
{
    for (int k = 0; k < 9; k++)
        if (!(u[k / 3][k % 3] >= box->lo[k % 3] && u[k / 3][k % 3] <= box->hi[k % 3]))
            return false;
    return true;
}

static void find_inside(fuzz_case *q)
{
    bool inside[PAIRS_DRAWN];
    for (unsigned i = 0; i < q->asked.drawn; i++)
        inside[i] = is_inside(triangle_of(&q->asked.pair[i]), &q->box);
    for (size_t i = 0; i < q->soup.count; i++)
        q->inside[i / 64] |= (uint64_t)inside[i % q->asked.drawn] << i % 64;
}

/* The first bit that is `wanted`, or the count. */
static size_t first_bit(const uint64_t *mask, size_t count, bool wanted)
{
    size_t i = 0;
    while (i < count && mask_bit(mask, i) != wanted)
        i++;
    return i;
}

static void check_any_and_all(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    size_t any, all;
    status_fits("tribox_find", 0, tribox_find(&q->soup, &q->box, o, TRIBOX_FIRST_HIT, &any));
    status_fits("tribox_find", 0, tribox_find(&q->soup, &q->box, o, TRIBOX_FIRST_MISS, &all));
    ensure(any == first_bit(mask, q->soup.count, true), "accuracy %d, axes %u, kernel %s: any finds %zu", (int)o->accuracy, o->axes,
           o->kernel, any);
    ensure(all == first_bit(mask, q->soup.count, false), "accuracy %d, axes %u, kernel %s: all finds %zu", (int)o->accuracy,
           o->axes, o->kernel, all);
}

/*
 * Once with all outputs, once with the masks each alone. What is inside overlaps, even where FAST alone has lost it; FAST may
 * answer words exactly.
 */
static void check_classify(const fuzz_case *q, const tribox_options *o, const uint64_t *mask, const uint64_t *exact)
{
    const size_t count = q->soup.count, bytes = tribox_mask_words(count) * sizeof *mask;
    uint64_t *const overlapping = tight_mask(count), *const inside = tight_mask(count), *const again = tight_mask(count);
    tribox_report counts;
    status_fits("tribox_classify", 0, tribox_classify(&q->soup, &q->box, o, overlapping, inside, &counts));
    ensure(counts.overlapping == mask_population("tribox_classify", overlapping, count), "tribox_classify reports %zu overlapping",
           counts.overlapping);
    ensure(!memcmp(inside, q->inside, bytes), "accuracy %d, axes %u, kernel %s: inside is wrong", (int)o->accuracy, o->axes,
           o->kernel);
    for (size_t w = 0; w < tribox_mask_words(count); w++)
        ensure((overlapping[w] == (mask[w] | (o->accuracy == TRIBOX_FAST ? inside[w] : 0)) ||
                (o->accuracy == TRIBOX_FAST && overlapping[w] == exact[w])) &&
                   !(inside[w] & ~overlapping[w]),
               "accuracy %d, axes %u, kernel %s: classify and overlap differ", (int)o->accuracy, o->axes, o->kernel);
    if (o->kernel != runnable_kernels()[0])
        return;
    status_fits("tribox_classify", 0, tribox_classify(&q->soup, &q->box, o, NULL, again, NULL));
    ensure(!memcmp(again, inside, bytes), "classify without a mask answers otherwise");
    status_fits("tribox_classify", 0, tribox_classify(&q->soup, &q->box, o, again, NULL, NULL));
    ensure(!memcmp(again, overlapping, bytes), "classify without inside answers otherwise");
}

static void check_indices(const uint64_t *mask, size_t count)
{
    size_t population = 0, listed = 0;
    for (size_t i = 0; i < count; i++)
        population += mask_bit(mask, i);
    uint32_t *const indices = tight_memory(population * sizeof *indices, 0);
    ensure(tribox_mask_indices(mask, count, NULL) == population, "tribox_mask_indices does not count %zu bits", population);
    ensure(tribox_mask_indices(mask, count, indices) == population, "tribox_mask_indices does not list %zu bits", population);
    for (size_t i = 0; i < count; i++)
        if (mask_bit(mask, i))
            ensure(indices[listed++] == i, "bit %zu is not listed", i);
}

/* What lies past the count of a mask is ignored. */
static void check_any_indices(input *in)
{
    const size_t count = input_byte(in);
    uint64_t *const mask = tight_mask(count);
    for (size_t w = 0; w < tribox_mask_words(count); w++)
        for (int byte = 0; byte < 8; byte++)
            mask[w] = mask[w] << 8 | input_byte(in);
    check_indices(mask, count);
}

static void check_not_finite(const fuzz_case *q)
{
    size_t found = 0, lowest = q->soup.count, first;
    for (size_t i = q->soup.count; i-- > 0;) {
        const const_triangle u = triangle_of(&q->asked.pair[i % q->asked.drawn]);
        if (!triangle_is_finite(u)) {
            found++;
            lowest = i;
        }
    }
    ensure(tribox_soup_not_finite(&q->soup, &first) == found && first == lowest, "%zu triangles are not finite, the first is %zu",
           found, lowest);
}

static void check_refusals(const fuzz_case *q, unsigned wrong)
{
    const size_t bytes = tribox_mask_words(q->soup.count) * sizeof(uint64_t);
    const tribox_options *const o = &q->asked.how.options;
    uint64_t *const mask = tight_mask(q->soup.count), *const inside = tight_mask(q->soup.count);
    tribox_report report;
    size_t first;
    memset(&report, POISON, sizeof report);
    memset(&first, POISON, sizeof first);
    status_fits("tribox_find", wrong, tribox_find(&q->soup, &q->box, o, TRIBOX_FIRST_HIT, &first));
    status_fits("tribox_find", wrong, tribox_find(&q->soup, &q->box, o, TRIBOX_FIRST_MISS, &first));
    status_fits("tribox_classify", wrong, tribox_classify(&q->soup, &q->box, o, mask, inside, &report));
    ensure(is_poisoned(&first, sizeof first), "any or all writes although it refuses");
    ensure(is_poisoned(mask, bytes) && is_poisoned(inside, bytes) && is_poisoned(&report, sizeof report),
           "tribox_classify writes although it refuses");
}

static void check_answers(const fuzz_case *q)
{
    tribox_options o = q->asked.how.options;
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++) {
        const uint64_t *exact = NULL;
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            uint64_t *const mask = tight_mask(q->soup.count);
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            status_fits("tribox_overlap", 0, tribox_overlap(&q->soup, &q->box, &o, mask, NULL));
            check_any_and_all(q, &o, mask);
            if (o.accuracy == TRIBOX_EXACT) {
                exact = mask;
                check_indices(mask, q->soup.count);
            }
            check_classify(q, &o, mask, exact);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    fuzz_case q = {.asked = {.how = input_options(&in)}};
    asked *const a = &q.asked;
    const size_t shift = input_below(&in, 4);
    a->count = input_count(&in);
    q.box = input_box(&in);
    do
        input_triangle(&in, a->pair[a->drawn++].u);
    while (!input_is_over(&in) && a->drawn < PAIRS_DRAWN && a->drawn < a->count);
    q.soup = asked_soup(a, shift);
    const unsigned wrong = a->how.wrong | (box_is_finite(&q.box) ? 0 : 1u << TRIBOX_BAD_BOX);
    check_not_finite(&q);
    find_inside(&q);
    if (wrong)
        check_refusals(&q, wrong);
    else
        check_answers(&q);
    check_any_indices(&in);
    tight_memory_free_all();
    return 0;
}
