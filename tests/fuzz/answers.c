#include "answers.h"

#include <math.h>
#include <string.h>

#include "ensure.h"
#include "common/kernels_here.h"
#include "tight_memory.h"

const char *const *runnable_kernels(void)
{
    static const char *names[KERNELS_MAX + 1];
    if (!names[0])
        kernels_here(names);
    return names;
}

drawn_options input_options(input *in)
{
    static const unsigned orders[] = {0, 123, 132, 213, 231, 312, 321};
    drawn_options drawn = {.options.axes = input_byte(in) & 7, .wrong = 0};
    drawn.options.axis_order = orders[input_below(in, sizeof orders / sizeof orders[0])];
    switch (input_byte(in)) {
    case 0xff:
        drawn.options.accuracy = (tribox_accuracy)(TRIBOX_FAST + 1);
        drawn.wrong = 1u << TRIBOX_BAD_OPTION;
        break;
    case 0xfe:
        drawn.options.axes |= 8;
        drawn.wrong = 1u << TRIBOX_BAD_OPTION;
        break;
    case 0xfd:
        drawn.options.axis_order = 100 * input_below(in, 4) + 11;
        drawn.wrong = 1u << TRIBOX_BAD_OPTION;
        break;
    case 0xfc:
        drawn.options.kernel = "none";
        drawn.wrong = 1u << TRIBOX_NO_KERNEL;
        break;
    default:
        break;
    }
    return drawn;
}

bool triangle_is_finite(const float u[3][3])
{
    for (int k = 0; k < 9; k++)
        if (!isfinite(u[k / 3][k % 3]))
            return false;
    return true;
}

bool box_is_finite(const tribox_box *box)
{
    for (int a = 0; a < 3; a++)
        if (!isfinite(box->lo[a]) || !isfinite(box->hi[a]))
            return false;
    return true;
}

bool box_is_empty(const tribox_box *box) { return box->lo[0] > box->hi[0] || box->lo[1] > box->hi[1] || box->lo[2] > box->hi[2]; }

size_t mask_population(const char *call, const uint64_t *mask, size_t count)
{
    size_t population = 0;
    for (size_t w = 0; w < tribox_mask_words(count); w++)
        for (uint64_t left = mask[w]; left; left &= left - 1)
            population++;
    ensure(count % 64 == 0 || mask[count / 64] >> count % 64 == 0, "%s sets bits past the count of %zu", call, count);
    return population;
}

bool status_fits(const char *call, unsigned wrong, tribox_status status)
{
    ensure(wrong ? status && wrong >> status & 1 : status == TRIBOX_OK, "%s returns status %d, expected are the bits of %#x", call,
           (int)status, wrong);
    return !wrong;
}

enum { WORDS_MAX = (COUNT_MAX + 63) / 64 };

/* The bits that are set in the true mask, and those that no accuracy may set: pairs that are not finite, or of an empty box. */
typedef struct truth {
    uint64_t overlapping[WORDS_MAX], impossible[WORDS_MAX];
} truth;

static bool can_overlap(const pair_f32 *pair)
{
    const const_triangle u = triangle_of(pair);
    return triangle_is_finite(u) && box_is_finite(&pair->box) && !box_is_empty(&pair->box);
}

static truth truth_of(const asked *a)
{
    const unsigned axes = a->how.options.axes ? a->how.options.axes : TRIBOX_AXES_ALL;
    truth t = {{0}, {0}};
    bool is_possible[PAIRS_DRAWN], overlaps[PAIRS_DRAWN];
    for (unsigned i = 0; i < a->drawn; i++) {
        is_possible[i] = can_overlap(&a->pair[i]);
        overlaps[i] = is_possible[i] && oracle_overlaps(oracle_separating(&a->pair[i]), axes);
    }
    for (size_t i = 0; i < a->count; i++) {
        t.overlapping[i / 64] |= (uint64_t)overlaps[i % a->drawn] << i % 64;
        t.impossible[i / 64] |= (uint64_t)!is_possible[i % a->drawn] << i % 64;
    }
    return t;
}

static void fail_pair(const asked *a, const tribox_options *o, size_t i, bool bit)
{
    const pair_f32 *const pair = &a->pair[i % a->drawn];
    if (can_overlap(pair))
        oracle_explain(stderr, pair);
    ensure(false, "%s, accuracy %d, axes %u, order %u, kernel %s: bit %zu of %zu is %d", a->call, (int)o->accuracy, o->axes,
           o->axis_order, o->kernel, i, a->count, bit);
}

static void check_mask(const asked *a, const tribox_options *o, const truth *t, const uint64_t *mask)
{
    const bool is_exact = o->accuracy == TRIBOX_EXACT || (o->accuracy == TRIBOX_FAST && a->is_lattice);
    for (size_t w = 0; w < tribox_mask_words(a->count); w++) {
        const uint64_t must = is_exact || o->accuracy == TRIBOX_CONSERVATIVE ? t->overlapping[w] : 0;
        const uint64_t may = is_exact ? t->overlapping[w] : ~t->impossible[w];
        const uint64_t wrong = (must & ~mask[w]) | (mask[w] & ~may);
        for (size_t i = 0; wrong && i < 64; i++)
            if (wrong >> i & 1)
                fail_pair(a, o, 64 * w + i, mask[w] >> i & 1);
    }
}

static void check_report(const asked *a, const tribox_options *o, const uint64_t *mask, const tribox_report *report)
{
    const size_t population = mask_population(a->call, mask, a->count);
    ensure(report->overlapping == population, "%s reports %zu overlapping, the mask has %zu", a->call, report->overlapping,
           population);
    ensure(report->undecided <= (o->accuracy == TRIBOX_FAST ? 0 : a->count), "%s reports %zu of %zu undecided", a->call,
           report->undecided, a->count);
}

/* Counts alone, and a mask alone, are those of both. */
static void check_halves(const asked *a, asking *ask, const void *about, const tribox_options *o, const uint64_t *mask,
                         const tribox_report *report)
{
    tribox_report alone = {0, 0};
    uint64_t *const again = tight_mask(a->count);
    status_fits(a->call, 0, ask(about, o, NULL, &alone));
    ensure(alone.overlapping == report->overlapping && alone.undecided == report->undecided, "%s without a mask counts otherwise",
           a->call);
    status_fits(a->call, 0, ask(about, o, again, NULL));
    ensure(!memcmp(again, mask, tribox_mask_words(a->count) * sizeof *mask), "%s without a report answers otherwise", a->call);
}

static void check_refusal(const asked *a, asking *ask, const void *about)
{
    tribox_report report;
    uint64_t *const mask = tight_mask(a->count);
    memset(&report, POISON, sizeof report);
    status_fits(a->call, a->wrong | a->how.wrong, ask(about, &a->how.options, mask, &report));
    ensure(is_poisoned(mask, tribox_mask_words(a->count) * sizeof *mask) && is_poisoned(&report, sizeof report),
           "%s writes although it refuses", a->call);
}

void answers_check(const asked *a, asking *ask, const void *about)
{
    if (a->wrong | a->how.wrong) {
        check_refusal(a, ask, about);
        return;
    }
    const truth t = truth_of(a);
    tribox_options o = a->how.options;
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            tribox_report report;
            uint64_t *const mask = tight_mask(a->count);
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            status_fits(a->call, 0, ask(about, &o, mask, &report));
            check_report(a, &o, mask, &report);
            check_mask(a, &o, &t, mask);
            if (kernel == runnable_kernels())
                check_halves(a, ask, about, &o, mask, &report);
        }
}

tribox_soup asked_soup(const asked *a, size_t shift)
{
    tribox_soup soup = {.count = a->count};
    const float **const streams[3] = {soup.x, soup.y, soup.z};
    for (int k = 0; k < 9; k++) {
        float *const stream = tight_memory(a->count * sizeof *stream, shift * sizeof *stream);
        for (size_t i = 0; i < a->count; i++)
            stream[i] = a->pair[i % a->drawn].u[k % 3][k / 3];
        streams[k / 3][k % 3] = stream;
    }
    return soup;
}
