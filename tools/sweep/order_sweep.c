/* order_sweep.c - enters, verifies and times the orders. */
#include "order_sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const unsigned sweep_orders[SWEEP_ORDERS] = {SWEEP_DEFAULT, 123, 132, 213, 231, 312, 321};
const tribox_accuracy sweep_accuracies[SWEEP_ACCURACIES] = {TRIBOX_FAST, TRIBOX_CONSERVATIVE, TRIBOX_EXACT};

const unsigned sweep_axes[SWEEP_AXES] = {
    TRIBOX_AXES_BOX,   TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE,  TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES, TRIBOX_AXES_PLANE,
    TRIBOX_AXES_EDGES, TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES};

static void enter(sweep *s, const timing_work *work, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order)
{
    const tribox_options options = {.accuracy = accuracy, .axes = axes, .axis_order = order, .kernel = kernel};
    s->list[s->count++] = contestant_kernel(work, &options);
}

static void enter_all(sweep *s, const timing_work *work)
{
    const char *kernel;
    s->count = 0;
    for (int o = 1; o < SWEEP_ORDERS; o++)
        s->list[s->count++] = contestant_paper(work, sweep_orders[o]);
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++) {
        for (int a = 0; a < SWEEP_ACCURACIES; a++)
            for (int o = 0; o < SWEEP_ORDERS; o++)
                enter(s, work, kernel, sweep_accuracies[a], TRIBOX_AXES_ALL, sweep_orders[o]);
        for (int x = 0; x < SWEEP_AXES; x++)
            enter(s, work, kernel, TRIBOX_EXACT, sweep_axes[x], SWEEP_DEFAULT);
    }
}

const char *sweep_run(sweep *s, const timing_work *work, effort how, generator *turns)
{
    static char wrong[VERIFY_TEXT];
    const truth from = truth_of_work(work);
    enter_all(s, work);
    if (!verify(s->list, s->count, &from, s->scores, wrong))
        return wrong;
    uint64_t *const mask = malloc((work->words + 1) * sizeof *mask);
    if (!mask)
        return "out of memory for the answers";
    measure(s->list, s->count, how, turns, mask, &s->taken);
    free(mask);
    return NULL;
}

static bool is_kernel(const contestant *one, const char *kernel)
{
    return kernel && one->options.kernel ? !strcmp(one->options.kernel, kernel) : one->options.kernel == kernel;
}

const contestant *sweep_find(const sweep *s, const char *kernel, tribox_accuracy accuracy, unsigned axes, unsigned order)
{
    for (const contestant *one = s->list; one < s->list + s->count; one++)
        if (is_kernel(one, kernel) && one->options.accuracy == accuracy && one->options.axes == axes &&
            one->options.axis_order == order)
            return one;
    return NULL;
}

static size_t index_of(const sweep *s, const contestant *of) { return (size_t)(of - s->list); }

const score *sweep_score(const sweep *s, const contestant *of) { return &s->scores[index_of(s, of)]; }

double sweep_time(const sweep *s, const contestant *of) { return measure_spread(&s->taken, index_of(s, of)).least; }

bool sweep_beats(const sweep *s, const contestant *one, const contestant *other)
{
    const size_t won = measure_wins(&s->taken, index_of(s, one), index_of(s, other));
    return sweep_time(s, one) < 0.99 * sweep_time(s, other) && 4 * won >= 3 * s->taken.rounds;
}

const contestant *sweep_best(const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const contestant *best = NULL;
    for (int o = 1; o < SWEEP_ORDERS; o++) {
        const contestant *const one = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o]);
        if (!best || sweep_time(s, one) < sweep_time(s, best))
            best = one;
    }
    return best;
}
