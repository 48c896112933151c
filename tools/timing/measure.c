/* measure.c - rounds of samples, and what they say. */
#define _POSIX_C_SOURCE 200809L
#include "measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "console/clock.h"

/* Windows counts the time of threads in ticks of 15 ms. */
static bool has_fine_thread_time(void)
{
    struct timespec step;
    return !clock_getres(CLOCK_THREAD_CPUTIME_ID, &step) && !step.tv_sec && step.tv_nsec <= 1000;
}

/* Of the processor, which other work does not move as it moves those of the clock; of the clock where threads share the work. */
static double seconds_now(const contestant *one)
{
    struct timespec now;
    if (one->has_threads || !has_fine_thread_time() || clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now))
        return clock_seconds();
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double seconds_for(const contestant *one, size_t runs, uint64_t *mask)
{
    double seconds = 0, begin = seconds_now(one);
    for (size_t i = 0; i < runs; i++) {
        if (one->prepare) {
            seconds += seconds_now(one) - begin;
            one->prepare(one, mask);
            begin = seconds_now(one);
        }
        one->run(one, mask, NULL);
    }
    return seconds + seconds_now(one) - begin;
}

/* Runs that last long enough, by the better of two tries: one interruption must not leave a contestant with short samples. */
static size_t calibrate(const contestant *one, double sample, uint64_t *mask)
{
    for (size_t runs = 1; sample > 0;) {
        double seconds = seconds_for(one, runs, mask);
        if (seconds < 8 * sample)
            seconds = fmin(seconds, seconds_for(one, runs, mask));
        if (seconds >= sample)
            return runs;
        runs *= (size_t)fmin(fmax(1.2 * sample / fmax(seconds, 1e-7), 2), 100);
    }
    return 1;
}

static void shuffle(size_t *turns, size_t count, generator *g)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = random_below(g, i), held = turns[i - 1];
        turns[i - 1] = turns[j];
        turns[j] = held;
    }
}

/* Round 0 warms up. A contestant that is timed once keeps its time of round 1. */
static void take_turn(const contestant *one, size_t runs, size_t round, uint64_t *mask, double *ns)
{
    if (one->is_timed_once && round != 1) {
        if (round)
            ns[round - 1] = ns[0];
        return;
    }
    const double seconds = seconds_for(one, runs, mask);
    if (round)
        ns[round - 1] = 1e9 * seconds / ((double)runs * one->pairs);
}

void measure(const contestant *list, size_t count, effort how, generator *order, uint64_t *mask, samples *taken)
{
    size_t runs[CONTESTANTS_MAX], turns[CONTESTANTS_MAX];
    const double begin = clock_seconds();
    for (size_t c = 0; c < count; c++) {
        turns[c] = c;
        runs[c] = list[c].is_timed_once ? 1 : calibrate(&list[c], how.sample, mask);
    }
    taken->contestants = count;
    taken->rounds = 0;
    for (size_t round = 0; round <= how.rounds; round++) {
        if (round > MEASURE_LEAST && clock_seconds() - begin > how.seconds)
            return;
        shuffle(turns, count, order);
        for (size_t t = 0; t < count; t++)
            take_turn(&list[turns[t]], runs[turns[t]], round, mask, taken->ns[turns[t]]);
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

size_t measure_wins(const samples *taken, size_t of, size_t to)
{
    size_t won = 0;
    for (size_t r = 0; r < taken->rounds; r++)
        won += taken->ns[of][r] < taken->ns[to][r];
    return won;
}

size_t measure_disturbed(const samples *taken)
{
    size_t disturbed = 0;
    for (size_t c = 0; c < taken->contestants; c++) {
        const spread s = measure_spread(taken, c);
        disturbed += s.median > 1.1 * s.least;
    }
    return disturbed;
}
