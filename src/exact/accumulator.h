/*
 * accumulator.h - sums of products of doubles, exactly: long enough for any that are finite. No allocation. The including file
 * defines ACCUMULATOR_FACTORS, the most that a product has.
 *
 * A double is an integer below 2^53 times a power of two from 2^-1074 to 2^971. So a product of three is an integer below 2^159
 * times a power from 2^-3222 on, of which digit 0 of a sum is the first 32 bits: 66 digits for each factor are enough (PROOFS.md
 * 9.3).
 */
#ifndef TRIBOX_EXACT_ACCUMULATOR_H
#define TRIBOX_EXACT_ACCUMULATOR_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/compiler.h"

enum { ACCUMULATOR_DIGITS = 66 * ACCUMULATOR_FACTORS, ACCUMULATOR_LEAST = -1074 };

/* Digits may be of any size and sign until the sum is read. */
typedef struct accumulator {
    int64_t digit[ACCUMULATOR_DIGITS];
    int first, end; /* the others are zero, and not written */
} accumulator;

static inline void accumulator_clear(accumulator *sum) { sum->first = sum->end = 0; }

static void accumulator_reach(accumulator *sum, int first, int end)
{
    if (sum->first == sum->end)
        sum->first = sum->end = first;
    while (sum->first > first)
        sum->digit[--sum->first] = 0;
    while (sum->end < end)
        sum->digit[sum->end++] = 0;
}

/* Digits of a product, the lowest first: of three, 31 bits of a shift and 53 of each need six, and multiplying writes one more. */
enum { PRODUCT_DIGITS = 2 * ACCUMULATOR_FACTORS + 1 };

/* Multiplies the lowest `count` digits, which become two more. m is below 2^53. */
static void accumulator_multiply(uint32_t digit[PRODUCT_DIGITS], int count, uint64_t m)
{
    const uint64_t low = m & 0xffffffff, high = m >> 32;
    uint64_t carry = 0, before = 0; /* before: the digit that was below this one */
    for (int k = 0; k < count + 2; k++) {
        const uint64_t here = k < count ? digit[k] : 0;
        const uint64_t by_low = here * low + (carry & 0xffffffff), by_high = before * high + (by_low & 0xffffffff);
        digit[k] = (uint32_t)by_high;
        carry = (carry >> 32) + (by_low >> 32) + (by_high >> 32);
        before = here;
    }
}

/* Adds a product of at most so many factors, none of which is zero. */
static void accumulator_add(accumulator *sum, const double factor[], int count)
{
    uint64_t m[ACCUMULATOR_FACTORS];
    int shift = 0;
    bool is_negative = false;
    for (int k = 0; k < count; k++) {
        uint64_t bits;
        memcpy(&bits, &factor[k], sizeof bits);
        const int field = (int)(bits >> 52 & 0x7ff);
        m[k] = (bits & UINT64_C(0xfffffffffffff)) | (field ? UINT64_C(1) << 52 : 0);
        shift += field ? field - 1 : 0;
        is_negative ^= bits >> 63;
    }
    shift -= (ACCUMULATOR_FACTORS - count) * ACCUMULATOR_LEAST;
    uint32_t digit[PRODUCT_DIGITS] = {UINT32_C(1) << shift % 32};
    for (int k = 0; k < count; k++)
        accumulator_multiply(digit, 2 * k + 1, m[k]);
    const int at = shift / 32, digits = 2 * count + 1;
    accumulator_reach(sum, at, at + digits);
    for (int k = 0; k < digits; k++)
        sum->digit[at + k] += is_negative ? -(int64_t)digit[k] : (int64_t)digit[k];
}

static int accumulator_sign(const accumulator *sum)
{
    int64_t carry = 0;
    bool has_digits = false;
    for (int k = sum->first; k < sum->end; k++) {
        carry += sum->digit[k];
        has_digits = has_digits || (carry & 0xffffffff);
        carry = carry >= 0 ? carry >> 32 : -((UINT32_MAX - carry) >> 32); /* rounded down */
    }
    return carry < 0 ? -1 : carry > 0 || has_digits;
}

#endif
