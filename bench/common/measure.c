#define _POSIX_C_SOURCE 200809L
#include "measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double measure_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Scenes, and room for a mask of any of them. A pass takes all of them in turn. */
typedef struct field {
    const scene *at;
    size_t scenes;
    uint64_t *mask;
} field;

static double seconds_for(const contestant *one, const field *f, size_t passes)
{
    const double begin = measure_now();
    for (size_t pass = 0; pass < passes; pass++)
        for (size_t s = 0; s < f->scenes; s++)
            contest_run(one, &f->at[s], f->mask);
    return measure_now() - begin;
}

static double triangles_of(const field *f)
{
    double sum = 0;
    for (size_t s = 0; s < f->scenes; s++)
        sum += (double)f->at[s].soup.count;
    return sum;
}

/* Passes that last long enough, by the better of two tries: one interruption must not leave a contestant with short samples. */
static size_t calibrate(const contestant *one, const field *f, double sample)
{
    size_t passes = 1;
    for (;;) {
        const double first = seconds_for(one, f, passes), second = seconds_for(one, f, passes);
        const double seconds = fmin(first, second);
        if (seconds >= sample)
            return passes;
        const double needed = 1.2 * sample / fmax(seconds, 1e-7);
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

void measure(const contestant *list, size_t count, const scene *at, size_t scenes, effort how, generator *order, uint64_t *mask,
             samples *taken)
{
    const field f = {at, scenes, mask};
    const double triangles = triangles_of(&f);
    size_t passes[CONTESTANTS_MAX], turn[CONTESTANTS_MAX];
    const double begin = measure_now();
    for (size_t c = 0; c < count; c++) {
        turn[c] = c;
        passes[c] = calibrate(&list[c], &f, how.sample);
    }
    taken->contestants = count;
    taken->rounds = 0;
    for (size_t round = 0; round <= how.rounds; round++) {
        if (round > MEASURE_LEAST && measure_now() - begin > how.seconds)
            return;
        shuffle(turn, count, order);
        for (size_t t = 0; t < count; t++) {
            const size_t c = turn[t];
            const double seconds = seconds_for(&list[c], &f, passes[c]);
            if (round > 0)
                taken->ns[c][round - 1] = 1e9 * seconds / ((double)passes[c] * triangles);
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

void measure_warn_if_disturbed(const samples *taken)
{
    size_t disturbed = 0;
    for (size_t c = 0; c < taken->contestants; c++)
        disturbed += measure_spread(taken, c).median > 1.1 * measure_spread(taken, c).least;
    if (disturbed)
        printf("disturbed: %zu of %zu have a median more than 10 %% above their least; trust the least times, or run again\n",
               disturbed, taken->contestants);
}
