/* random.h - a small seeded generator: splitmix64. The same seed draws the same numbers on every machine. */
#ifndef TRIBOX_TESTS_RANDOM_H
#define TRIBOX_TESTS_RANDOM_H

#include <stdint.h>

typedef struct random_source {
    uint64_t state;
} random_source;

static inline uint64_t random_bits(random_source *r)
{
    uint64_t z = r->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

/* A stream of its own for every name, so that one scene can be drawn again without those before it. */
static inline random_source random_named(uint64_t seed, const char *name)
{
    random_source r = {seed};
    for (; *name; name++)
        r.state = random_bits(&r) ^ (uint64_t)(unsigned char)*name;
    return r;
}

/* 0 to count - 1 */
static inline int random_below(random_source *r, int count) { return (int)(random_bits(r) % (uint64_t)count); }

/* least to most, both included */
static inline int random_between(random_source *r, int least, int most) { return least + random_below(r, most - least + 1); }

static inline double random_uniform(random_source *r, double least, double most)
{
    return least + (most - least) * (double)(random_bits(r) >> 11) * 0x1p-53;
}

/* A zero with a sign that is drawn; any other number as it is. */
static inline float random_sign_of_zero(random_source *r, float number)
{
    return number != 0 ? number : random_below(r, 2) ? -0.0f : 0.0f;
}

#endif
