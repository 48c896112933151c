/* trial.c - times contestants in turns, so that a busy moment of the machine hits all of them alike. */
#define _POSIX_C_SOURCE 200809L
#include "trial.h"

#include <stdlib.h>

#include "paper/baseline.h"
#include "console/clock.h"
#include "console/message.h"
#include "paper/random.h"

static void enter_all(trial *t)
{
    t->contestants[t->count++] = (contestant){.kernel = NULL};
    for (size_t k = 0; k < TRIAL_KERNELS_MAX && tribox_kernel_list(k); k++)
        for (int i = 0; i < TRIAL_ACCURACIES; i++) {
            static const tribox_accuracy accuracies[TRIAL_ACCURACIES] = {TRIBOX_FAST, TRIBOX_CONSERVATIVE, TRIBOX_EXACT};
            t->contestants[t->count++] = (contestant){.kernel = tribox_kernel_list(k), .accuracy = accuracies[i]};
        }
}

static int take_turn(const scene *s, const contestant *c, uint64_t *mask)
{
    if (!c->kernel) {
        baseline_overlap_soup(s->center, s->half, (const float(*)[3][3])s->triangles, s->soup.count, mask);
        return EXIT_CODE_OK;
    }
    const tribox_options options = {.accuracy = c->accuracy, .kernel = c->kernel};
    const tribox_status status = tribox_overlap(&s->soup, &s->box, &options, mask, NULL);
    return status ? message_failure("%s", tribox_status_text(status)) : EXIT_CODE_OK;
}

static size_t count_bits(uint64_t word)
{
    size_t count = 0;
    for (; word; word &= word - 1)
        count++;
    return count;
}

static void compare_with_exact(const trial *t, size_t words, contestant *c)
{
    c->overlapping = c->differing = 0;
    for (size_t w = 0; w < words; w++) {
        c->overlapping += count_bits(t->mask[w]);
        c->differing += count_bits(t->mask[w] ^ t->exact[w]);
    }
}

static void shuffle(int *order, int count, generator *g)
{
    for (int i = count; i > 1; i--) {
        const int k = (int)random_below(g, (size_t)i), taken = order[k];
        order[k] = order[i - 1];
        order[i - 1] = taken;
    }
}

/* Round -1 warms up and is not counted; its answers are compared. */
static int run_round(const scene *s, trial *t, int round, const int *order)
{
    for (int i = 0; i < t->count; i++) {
        contestant *c = &t->contestants[order[i]];
        const double start = clock_seconds();
        const int code = take_turn(s, c, t->mask);
        const double seconds = clock_seconds() - start;
        if (code)
            return code;
        if (round < 0)
            compare_with_exact(t, tribox_mask_words(s->soup.count), c);
        else
            c->seconds[round] = seconds;
    }
    return EXIT_CODE_OK;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int run_rounds(const scene *s, trial *t)
{
    generator g = {SCENE_SEED};
    int order[TRIAL_CONTESTANTS_MAX];
    int code = take_turn(s, &(contestant){.kernel = "scalar", .accuracy = TRIBOX_EXACT}, t->exact);
    for (int i = 0; i < t->count; i++)
        order[i] = i;
    for (int round = -1; !code && round < t->rounds; round++) {
        shuffle(order, t->count, &g);
        code = run_round(s, t, round, order);
    }
    for (int i = 0; !code && i < t->count; i++) {
        contestant *c = &t->contestants[i];
        qsort(c->seconds, (size_t)t->rounds, sizeof c->seconds[0], compare_doubles);
        c->median = c->seconds[t->rounds / 2];
    }
    return code;
}

int trial_run(const scene *s, int rounds, trial *t)
{
    const size_t words = tribox_mask_words(s->soup.count);
    *t = (trial){.rounds = rounds, .exact = malloc(words * sizeof(uint64_t)), .mask = malloc(words * sizeof(uint64_t))};
    enter_all(t);
    const int code = t->exact && t->mask ? run_rounds(s, t) : message_failure("out of memory for the answers");
    if (code)
        trial_free(t);
    return code;
}

void trial_free(trial *t)
{
    free(t->exact);
    free(t->mask);
    t->exact = t->mask = NULL;
}
