/* exact.c - one pair in integers that are wide enough for its numbers: the last stage, which decides everything. */
#include "exact.h"

#include <math.h>
#include <string.h>

/* A power of two, from the exponent's field of a double. */
static double power_of(int field)
{
    const uint64_t bits = (uint64_t)field << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

static double largest_of(const double number[TRIBOX_POINTS])
{
    double largest = 0;
    for (int k = 0; k < TRIBOX_POINTS; k++)
        largest = fabs(number[k]) > largest ? fabs(number[k]) : largest;
    return largest;
}

/* In units of 2^-59 of the power of two below the largest number. False where one is not a multiple of that (PROOFS.md 9.2). */
static bool count_units(const double number[TRIBOX_POINTS], int64_t to[TRIBOX_POINTS])
{
    const double largest = largest_of(number);
    uint64_t bits;
    memcpy(&bits, &largest, sizeof bits);
    const int field = (int)(bits >> 52), one = 1023;
    memset(to, 0, TRIBOX_POINTS * sizeof *to);
    if (field <= 59)
        return largest == 0;
    const double unit = power_of(field - 59), units = power_of(2 * one + 59 - field);
    bool is_counted = true;
    for (int k = 0; k < TRIBOX_POINTS; k++) {
        to[k] = (int64_t)(number[k] * units);
        is_counted = is_counted && (double)to[k] * unit == number[k];
    }
    return is_counted;
}

bool tribox_short_pair_of(const tribox_pair *pair, tribox_short_pair *to)
{
    for (int a = 0; a < 3; a++) {
        const double number[TRIBOX_POINTS] = {pair->u[0][a], pair->u[1][a], pair->u[2][a], pair->lo[a], pair->hi[a]};
        if (!count_units(number, to->at[a]))
            return false;
    }
    return true;
}

bool tribox_exact_overlap(const tribox_pair *pair, unsigned axes)
{
    tribox_short_pair counted;
    return tribox_short_pair_of(pair, &counted) ? tribox_exact_short(&counted, axes) : tribox_exact_long(pair, axes);
}
