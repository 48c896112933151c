/* window_bits.h - the bits of masks, and of the words of a grid or of a window, x first: where a cell has its own. */
#ifndef TRIBOX_TESTS_WINDOW_BITS_H
#define TRIBOX_TESTS_WINDOW_BITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static inline bool bit_of(const uint64_t *mask, size_t i) { return mask[i / 64] >> i % 64 & 1; }

/* The first bit that is `wanted`, or the count. */
static inline size_t first_bit(const uint64_t *mask, size_t count, bool wanted)
{
    size_t i = 0;
    while (i < count && bit_of(mask, i) != wanted)
        i++;
    return i;
}

static inline size_t bits_set(const uint64_t *mask, size_t words)
{
    size_t count = 0;
    for (size_t w = 0; w < words; w++)
        count += (size_t)__builtin_popcountll(mask[w]);
    return count;
}

static inline size_t window_row(const uint32_t size[3]) { return ((size_t)size[0] + 63) / 64; }

static inline size_t window_place(const uint32_t size[3], size_t i, size_t j, size_t k)
{
    return (k * size[1] + j) * window_row(size) + i / 64;
}

static inline bool window_bit(const uint32_t size[3], const uint64_t *words, size_t i, size_t j, size_t k)
{
    return words[window_place(size, i, j, k)] >> i % 64 & 1;
}

/* Sets it to what it is to be. */
static inline void window_put(const uint32_t size[3], uint64_t *words, size_t i, size_t j, size_t k, bool is_set)
{
    uint64_t *const word = &words[window_place(size, i, j, k)];
    *word = (*word & ~(UINT64_C(1) << i % 64)) | (uint64_t)is_set << i % 64;
}

#endif
