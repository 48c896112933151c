#define _POSIX_C_SOURCE 200809L
#include "order_measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "paper/order_paper.h"

const unsigned sweep_orders[SWEEP_ORDERS] = {123, 132, 213, 231, 312, 321};
const unsigned sweep_default_order = 132;
const tribox_accuracy sweep_accuracies[SWEEP_ACCURACIES] = {TRIBOX_FAST, TRIBOX_CONSERVATIVE, TRIBOX_EXACT};

const unsigned sweep_axes[SWEEP_AXES] = {
    TRIBOX_AXES_BOX,   TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE,  TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, TRIBOX_AXES_PLANE,
    TRIBOX_AXES_EDGES, TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES};

const char *sweep_accuracy_word(tribox_accuracy accuracy)
{
    return accuracy == TRIBOX_EXACT ? "exact" : accuracy == TRIBOX_CONSERVATIVE ? "conservative" : "fast";
}

const char *sweep_axes_word(unsigned axes)
{
    static const char *const words[] = {"132", "1", "2", "12", "3", "13", "32", "132"};
    return words[axes];
}

static void enter(sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order)
{
    s->list[s->entrants++] = (entrant){.options = {.accuracy = accuracy, .axes = axes, .order = order, .kernel = kernel}};
}

void sweep_enter(sweep *s, const char *const *kernels, size_t count)
{
    s->entrants = s->rounds = 0;
    for (int o = 0; o < SWEEP_ORDERS; o++)
        enter(s, NULL, TRIBOX_FAST, TRIBOX_AXES_ALL, sweep_orders[o]);
    for (size_t k = 0; k < count; k++) {
        for (int a = 0; a < SWEEP_ACCURACIES; a++)
            for (int o = 0; o < SWEEP_ORDERS; o++)
                enter(s, kernels[k], sweep_accuracies[a], TRIBOX_AXES_ALL, sweep_orders[o]);
        for (int x = 0; x < SWEEP_AXES; x++)
            enter(s, kernels[k], TRIBOX_EXACT, sweep_axes[x], sweep_default_order);
    }
}

static void run_paper(const order_job *job, unsigned order, uint64_t *mask)
{
    float center[3], half[3];
    for (int a = 0; a < 3; a++) {
        center[a] = (job->box.lo[a] + job->box.hi[a]) / 2;
        half[a] = (job->box.hi[a] - job->box.lo[a]) / 2;
    }
    paper_in_order(order)(center, half, job->triangles, job->soup.count, mask);
}

/* One pass over the work: what is timed. False if the library refuses. */
static bool run(const entrant *one, const order_work *work, uint64_t *mask, tribox_report *total)
{
    *total = (tribox_report){0, 0};
    for (size_t i = 0; i < work->count; i++) {
        const order_job *const job = &work->jobs[i];
        tribox_report report = {0, 0};
        if (!one->options.kernel)
            run_paper(job, one->options.order, mask);
        else if (tribox_overlap(&job->soup, &job->box, &one->options, mask, &report))
            return false;
        total->overlapping += report.overlapping;
        total->undecided += report.undecided;
        mask += tribox_mask_words(job->soup.count);
    }
    return true;
}

static size_t count_bits(uint64_t word)
{
    size_t bits = 0;
    for (; word; word &= word - 1)
        bits++;
    return bits;
}

/* Entrants that have to answer alike: the same kernel, accuracy and axes in another order. */
static bool are_alike(const tribox_options *p, const tribox_options *q)
{
    const bool is_same_kernel = p->kernel && q->kernel ? !strcmp(p->kernel, q->kernel) : p->kernel == q->kernel;
    return is_same_kernel && p->accuracy == q->accuracy && p->axes == q->axes;
}

static const char *judge(const entrant *one, size_t missed, bool is_as_before)
{
    const bool is_exact = one->options.accuracy == TRIBOX_EXACT && one->options.axes == TRIBOX_AXES_ALL;
    return !is_as_before                                    ? "an order changes the answer of a kernel"
           : one->options.accuracy != TRIBOX_FAST && missed ? "EXACT or CONSERVATIVE misses an overlap"
           : is_exact && one->unlike                        ? "EXACT differs from the scalar kernel"
                                                            : NULL;
}

/* exact, mask, before: each of work->words words. */
static const char *verify_all(sweep *s, const order_work *work, uint64_t *exact, uint64_t *mask, uint64_t *before)
{
    const size_t bytes = work->words * sizeof *exact;
    const entrant reference = {.options = {.accuracy = TRIBOX_EXACT, .kernel = "scalar"}};
    tribox_report total;
    if (!run(&reference, work, exact, &total))
        return "tribox_overlap refuses the work";
    for (size_t e = 0; e < s->entrants; e++) {
        entrant *const one = &s->list[e];
        size_t missed = 0;
        memset(mask, 0xff, bytes); /* an entrant that writes nothing is seen */
        if (!run(one, work, mask, &total))
            return "tribox_overlap refuses the work";
        one->undecided = total.undecided;
        one->overlapping = one->unlike = 0;
        for (size_t w = 0; w < work->words; w++) {
            one->overlapping += count_bits(mask[w]);
            one->unlike += count_bits(mask[w] ^ exact[w]);
            missed += count_bits(exact[w] & ~mask[w]);
        }
        const bool is_as_before = !e || !are_alike(&one->options, &s->list[e - 1].options) || !memcmp(mask, before, bytes);
        const char *const wrong = judge(one, missed, is_as_before);
        if (wrong)
            return wrong;
        memcpy(before, mask, bytes);
    }
    return NULL;
}

const char *sweep_verify(sweep *s, const order_work *work)
{
    uint64_t *const masks = malloc(3 * (work->words + 1) * sizeof *masks);
    const char *const wrong =
        masks ? verify_all(s, work, masks, masks + work->words, masks + 2 * work->words) : "out of memory for the answers";
    free(masks);
    return wrong;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double seconds_for(const entrant *one, const order_work *work, size_t passes, uint64_t *mask)
{
    tribox_report unused;
    const double begin = now();
    for (size_t pass = 0; pass < passes; pass++)
        run(one, work, mask, &unused);
    return now() - begin;
}

/* Passes that last half a millisecond, from the faster of two where that is less than one pass. */
static size_t calibrate(const entrant *one, const order_work *work, uint64_t *mask)
{
    const double sample_seconds = 5e-4, first = seconds_for(one, work, 1, mask);
    if (first > sample_seconds)
        return 1;
    const double passes = sample_seconds / fmax(fmin(first, seconds_for(one, work, 1, mask)), 1e-7);
    return passes < 1 ? 1 : (size_t)passes;
}

static void shuffle(size_t *turn, size_t count, generator *g)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = random_below(g, i), held = turn[i - 1];
        turn[i - 1] = turn[j];
        turn[j] = held;
    }
}

const char *sweep_measure(sweep *s, const order_work *work, double seconds, size_t least, generator *turns)
{
    size_t passes[SWEEP_ENTRANTS_MAX], turn[SWEEP_ENTRANTS_MAX];
    uint64_t *const mask = malloc((work->words + 1) * sizeof *mask);
    const double begin = now(), pairs = (double)work->pairs;
    if (!mask)
        return "out of memory for the answers";
    for (size_t e = 0; e < s->entrants; e++) {
        turn[e] = e;
        passes[e] = calibrate(&s->list[e], work, mask);
    }
    s->rounds = 0;
    for (size_t round = 0; round <= SWEEP_ROUNDS_MAX && (round <= least || now() - begin < seconds); round++) {
        shuffle(turn, s->entrants, turns);
        for (size_t t = 0; t < s->entrants; t++) {
            const size_t e = turn[t];
            const double taken = seconds_for(&s->list[e], work, passes[e], mask);
            if (round > 0)
                s->ns[e][round - 1] = 1e9 * taken / ((double)passes[e] * pairs);
        }
        s->rounds = round;
    }
    free(mask);
    return NULL;
}

const entrant *sweep_find(const sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order)
{
    const tribox_options wanted = {.accuracy = accuracy, .axes = axes, .kernel = kernel};
    for (size_t e = 0; e < s->entrants; e++)
        if (are_alike(&s->list[e].options, &wanted) && s->list[e].options.order == order)
            return &s->list[e];
    return NULL;
}

double sweep_time(const sweep *s, const entrant *of)
{
    const double *const ns = s->ns[of - s->list];
    double least = ns[0];
    for (size_t r = 1; r < s->rounds; r++)
        least = fmin(least, ns[r]);
    return least;
}

bool sweep_beats(const sweep *s, const entrant *one, const entrant *other)
{
    const double *const ns = s->ns[one - s->list], *const others = s->ns[other - s->list];
    size_t won = 0;
    for (size_t r = 0; r < s->rounds; r++)
        won += ns[r] < others[r];
    return sweep_time(s, one) < 0.99 * sweep_time(s, other) && 4 * won >= 3 * s->rounds;
}

const entrant *sweep_best(const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const entrant *best = NULL;
    for (int o = 0; o < SWEEP_ORDERS; o++) {
        const entrant *const one = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o]);
        if (!best || sweep_time(s, one) < sweep_time(s, best))
            best = one;
    }
    return best;
}
