/* counting.h - take bricks, with ids and lists, and do nothing but count them. */
#ifndef BENCH_COUNTING_H
#define BENCH_COUNTING_H

#include "tribox.h"

/* count: a uint64_t. */
static inline int count_brick(void *count, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at, (void)bits;
    ++*(uint64_t *)count;
    return 0;
}

static inline int count_ids(void *count, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    (void)ids;
    return count_brick(count, at, bits);
}

static inline int count_lists(void *count, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513],
                              const uint32_t *list)
{
    (void)starts, (void)list;
    return count_brick(count, at, bits);
}

#endif
