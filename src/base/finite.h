/* finite.h - neither NaN nor infinite, from the bits: a comparison could raise flags, or trap, in the caller's environment. */
#ifndef TRIBOX_FINITE_H
#define TRIBOX_FINITE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "compiler.h"

static inline bool tribox_is_finite(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return (bits & 0x7f800000u) != 0x7f800000u;
}

static inline bool tribox_is_finite_double(double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return (bits & UINT64_C(0x7ff0000000000000)) != UINT64_C(0x7ff0000000000000);
}

static inline bool tribox_are_finite(const float *number, int count)
{
    bool are = true;
    for (int n = 0; n < count; n++)
        are &= tribox_is_finite(number[n]);
    return are;
}

static inline bool tribox_are_finite_doubles(const double *number, int count)
{
    bool are = true;
    for (int n = 0; n < count; n++)
        are &= tribox_is_finite_double(number[n]);
    return are;
}

#endif
