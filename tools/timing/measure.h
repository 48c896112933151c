/*
 * measure.h - times contestants against each other: interleaved in rounds, in a fresh random order each round, so that what
 * disturbs the machine disturbs all of them. Ratios are taken within a round. Times are those of the processor: a long pass that is
 * interrupted costs no more than a short one that is not.
 */
#ifndef TIMING_MEASURE_H
#define TIMING_MEASURE_H

#include "contestant.h"
#include "paper/random.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct effort {
    size_t rounds;  /* at most; one more is run first and dropped */
    double seconds; /* start no further round after this, but measure MEASURE_LEAST */
    double sample;  /* seconds that a sample lasts at the least: runs are repeated; 0 for one run */
} effort;

enum { MEASURE_LEAST = 5, MEASURE_MOST = 1000 };

/* ns[c][r]: nanoseconds per pair of contestant c in round r. Those of one round were measured within the same moments. */
typedef struct samples {
    size_t contestants, rounds;
    double ns[CONTESTANTS_MAX][MEASURE_MOST];
} samples;

/* mask: room for the answer of any of them. */
void measure(const contestant *list, size_t count, effort how, generator *order, uint64_t *mask, samples *taken);

typedef struct spread {
    double least, lower_quartile, median, upper_quartile;
} spread;

spread measure_spread(const samples *taken, size_t of);

/* The ratio of two contestants, taken pair by pair within the rounds: the time of `of` over that of `to`. */
spread measure_ratio(const samples *taken, size_t of, size_t to);

/* In how many rounds `of` was faster than `to`. */
size_t measure_wins(const samples *taken, size_t of, size_t to);

/* How many have a median more than 10 % above their least: a quiet machine repeats a contestant to a few percent. */
size_t measure_disturbed(const samples *taken);

#ifdef __cplusplus
}
#endif

#endif
