/* random.h - a seeded generator: the same scenes and the same permutations wherever the seed is the same. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stddef.h>
#include <stdint.h>

typedef struct generator {
    uint64_t state; /* any value is a seed */
} generator;

/* SplitMix64: a counter, well mixed. */
static inline uint64_t random_bits(generator *g)
{
    uint64_t z = g->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

/* Uniform in [lo, hi), on a grid of 2^24 values. */
static inline float random_between(generator *g, float lo, float hi)
{
    return lo + (hi - lo) * ((float)(random_bits(g) >> 40) * 0x1p-24f);
}

/* Uniform in [0, n); the bias of the remainder is below 2^-32 for every n in use here. */
static inline size_t random_below(generator *g, size_t n) { return (size_t)(random_bits(g) % n); }

#endif
