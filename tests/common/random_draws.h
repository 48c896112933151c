/* random_draws.h - what the tests draw from a seed. The same seed draws the same numbers on every machine. */
#ifndef TRIBOX_TESTS_RANDOM_DRAWS_H
#define TRIBOX_TESTS_RANDOM_DRAWS_H

#include "paper/random.h"

typedef generator random_source;

/* A sequence of its own for every name, so that one scene can be drawn again without those before it. */
static inline random_source random_named(uint64_t seed, const char *name)
{
    random_source r = {seed};
    for (; *name; name++)
        r.state = random_bits(&r) ^ (uint64_t)(unsigned char)*name;
    return r;
}

/* 0 to count - 1 */
static inline int random_int(random_source *r, int count) { return (int)random_below(r, (size_t)count); }

/* least to most, both included */
static inline int random_int_between(random_source *r, int least, int most) { return least + random_int(r, most - least + 1); }

static inline double random_double(random_source *r, double least, double most)
{
    return least + (most - least) * (double)(random_bits(r) >> 11) * 0x1p-53;
}

/* A zero with a random sign; any other number as it is. */
static inline float random_sign_of_zero(random_source *r, float number)
{
    return number != 0 ? number : random_int(r, 2) ? -0.0f : 0.0f;
}

#endif
