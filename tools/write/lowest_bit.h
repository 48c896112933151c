/* lowest_bit.h - where the lowest set bit of a word is, with any compiler. */
#ifndef LOWEST_BIT_H
#define LOWEST_BIT_H

#include <stdint.h>

/* Of a word that is not 0. */
static inline uint32_t lowest_bit(uint64_t word)
{
#if defined(__GNUC__)
    return (uint32_t)__builtin_ctzll(word);
#else
    uint32_t n = 0;
    for (uint32_t step = 32; step; step /= 2)
        if (!(word << (64 - step) >> (64 - step))) {
            word >>= step;
            n += step;
        }
    return n;
#endif
}

#endif
