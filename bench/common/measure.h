/* measure.h - times contestants against each other on the same scenes: interleaved in rounds, in a fresh order each round. */
#ifndef BENCH_MEASURE_H
#define BENCH_MEASURE_H

#include "contest.h"
#include "paper/random.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct effort {
    size_t rounds;  /* measured rounds at most; one more is run first and dropped */
    double seconds; /* start no further round after this long, but measure at least MEASURE_LEAST */
    double sample;  /* seconds that a sample takes at least: the pass over the scenes is repeated */
} effort;

enum { MEASURE_LEAST = 5, MEASURE_MOST = 1000 };

/** ns[c][r]: nanoseconds per triangle of contestant c in round r. Pairs in one round were measured within the same moments. */
typedef struct samples {
    size_t contestants, rounds;
    double ns[CONTESTANTS_MAX][MEASURE_MOST];
} samples;

/** mask: room for the mask of any of the scenes. */
void measure(const contestant *list, size_t count, const scene *at, size_t scenes, effort how, generator *order, uint64_t *mask,
             samples *taken);

/** Seconds from some moment on. */
double measure_now(void);

typedef struct spread {
    double least, lower_quartile, median, upper_quartile;
} spread;

spread measure_spread(const samples *taken, size_t of);

/** The ratio of two contestants, taken pair by pair within the rounds: the time of `of` over that of `to`. */
spread measure_ratio(const samples *taken, size_t of, size_t to);

/** Says so on stdout where other work took turns on the core: a quiet machine repeats a contestant to a few percent. */
void measure_warn_if_disturbed(const samples *taken);

#ifdef __cplusplus
}
#endif

#endif
