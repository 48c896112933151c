/*
 * wide.h - products of two 64-bit integers and their sums, in 128 bits: built in, or in two words where the compiler has no such
 * type. Nothing overflows: PROOFS.md 9.2 counts the bits.
 */
#ifndef TRIBOX_EXACT_WIDE_H
#define TRIBOX_EXACT_WIDE_H

#include <stdint.h>

#if defined(__SIZEOF_INT128__)

__extension__ typedef __int128 tribox_wide;

static inline tribox_wide tribox_wide_product(int64_t a, int64_t b) { return (tribox_wide)a * b; }
static inline tribox_wide tribox_wide_sum(tribox_wide a, tribox_wide b) { return a + b; }
static inline tribox_wide tribox_wide_difference(tribox_wide a, tribox_wide b) { return a - b; }
static inline int tribox_wide_sign(tribox_wide a) { return (a > 0) - (a < 0); }

/* a = 2^62 times what is returned, plus *low_bits, which is not negative and below 2^62. For a from -2^125 to below 2^125. */
static inline int64_t tribox_wide_split(tribox_wide a, int64_t *low_bits)
{
    *low_bits = (int64_t)(a & INT64_C(0x3fffffffffffffff));
    return (int64_t)(a >> 62);
}

#else

/* Modulo 2^128, negative numbers by their complement. */
typedef struct tribox_wide {
    uint64_t low, high;
} tribox_wide;

static inline tribox_wide tribox_wide_sum(tribox_wide a, tribox_wide b)
{
    const uint64_t low = a.low + b.low;
    return (tribox_wide){low, a.high + b.high + (low < a.low)};
}

static inline tribox_wide tribox_wide_difference(tribox_wide a, tribox_wide b)
{
    return (tribox_wide){a.low - b.low, a.high - b.high - (a.low < b.low)};
}

static inline tribox_wide tribox_wide_product(int64_t a, int64_t b)
{
    const uint64_t x = (uint64_t)a, y = (uint64_t)b;
    const uint64_t x0 = x & 0xffffffff, x1 = x >> 32, y0 = y & 0xffffffff, y1 = y >> 32;
    const uint64_t low = x0 * y0, middle = x1 * y0 + (low >> 32), other = x0 * y1 + (middle & 0xffffffff);
    const uint64_t high = x1 * y1 + (middle >> 32) + (other >> 32);
    /* Of a factor below zero, 2^64 too much was multiplied. */
    return (tribox_wide){other << 32 | (low & 0xffffffff), high - (a < 0 ? y : 0) - (b < 0 ? x : 0)};
}

static inline int tribox_wide_sign(tribox_wide a) { return a.high >> 63 ? -1 : (a.high | a.low) != 0; }

static inline int64_t tribox_wide_split(tribox_wide a, int64_t *low_bits)
{
    *low_bits = (int64_t)(a.low & UINT64_C(0x3fffffffffffffff));
    return (int64_t)(a.high << 2 | a.low >> 62);
}

#endif
#endif
