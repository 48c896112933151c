#define _POSIX_C_SOURCE 200809L
#include "measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double sample_seconds = 2e-3;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double seconds_for(const contestant *one, const scene *at, size_t passes, uint64_t *mask)
{
    const double begin = now();
    for (size_t pass = 0; pass < passes; pass++)
        contest_run(one, at, mask);
    return now() - begin;
}

/* Passes that last long enough, by the better of two tries: one interruption must not leave a contestant with short samples. */
static size_t calibrate(const contestant *one, const scene *at, uint64_t *mask)
{
    size_t passes = 1;
    for (;;) {
        const double first = seconds_for(one, at, passes, mask), second = seconds_for(one, at, passes, mask);
        const double seconds = fmin(first, second);
        if (seconds >= sample_seconds)
            return passes;
        const double needed = 1.2 * sample_seconds / fmax(seconds, 1e-7);
        passes *= (size_t)fmin(fmax(needed, 2), 100);
    }
}

static void shuffle(size_t *order, size_t count, generator *g)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = random_below(g, i), held = order[i - 1];
        order[i - 1] = order[j];
        order[j] = held;
    }
}

void measure(const contestant *list, size_t count, const scene *at, effort how, generator *order, uint64_t *mask, samples *taken)
{
    size_t passes[CONTESTANTS_MAX], turn[CONTESTANTS_MAX];
    const double begin = now();
    for (size_t c = 0; c < count; c++) {
        turn[c] = c;
        passes[c] = calibrate(&list[c], at, mask);
    }
    taken->contestants = count;
    taken->rounds = 0;
    for (size_t round = 0; round <= how.rounds; round++) {
        if (round > MEASURE_LEAST && now() - begin > how.seconds)
            return;
        shuffle(turn, count, order);
        for (size_t t = 0; t < count; t++) {
            const size_t c = turn[t];
            const double seconds = seconds_for(&list[c], at, passes[c], mask);
            if (round > 0)
                taken->ns[c][round - 1] = 1e9 * seconds / ((double)passes[c] * (double)at->soup.count);
        }
        taken->rounds = round;
    }
}

static int by_value(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Between neighbours in rank, the straight line. */
static double quantile(const double *sorted, size_t count, double part)
{
    const double rank = part * (double)(count - 1);
    const size_t below = (size_t)rank, above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (rank - (double)below) * (sorted[above] - sorted[below]);
}

static spread spread_of(double *values, size_t count)
{
    qsort(values, count, sizeof *values, by_value);
    return (spread){values[0], quantile(values, count, 0.25), quantile(values, count, 0.5), quantile(values, count, 0.75)};
}

spread measure_spread(const samples *taken, size_t of)
{
    double values[MEASURE_MOST];
    memcpy(values, taken->ns[of], taken->rounds * sizeof *values);
    return spread_of(values, taken->rounds);
}

spread measure_ratio(const samples *taken, size_t of, size_t to)
{
    double values[MEASURE_MOST];
    for (size_t r = 0; r < taken->rounds; r++)
        values[r] = taken->ns[of][r] / taken->ns[to][r];
    return spread_of(values, taken->rounds);
}
