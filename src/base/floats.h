/* floats.h - the float at an address, the nearest to a number, those beside one, and what a difference rounds off. */
#ifndef TRIBOX_FLOATS_H
#define TRIBOX_FLOATS_H

#include <stdint.h>
#include <string.h>

#include "compiler.h"

/* At any address, as the interface allows. To read it as one that is aligned is undefined, and faults on some 32-bit ARM. */
static inline float tribox_float_at(const void *from)
{
    float number;
    memcpy(&number, from, sizeof number);
    return number;
}

static inline void tribox_float_put(void *to, double number)
{
    const float rounded = (float)number;
    memcpy(to, &rounded, sizeof rounded);
}

/* Out of the compiler's sight, or gcc 12 takes doubles that a loop makes floats and doubles again for what they were. */
static inline float tribox_float_nearest(double number)
{
#if defined(__GNUC__) && defined(__SSE2__)
    float nearest = (float)number;
    __asm__("" : "+x"(nearest));
#else
    const volatile float nearest = (float)number;
#endif
    return nearest;
}

/* The float above a number that is not infinite, but for -infinity; infinite above the greatest. */
static inline float tribox_float_above(float number)
{
    int32_t bits;
    memcpy(&bits, &number, sizeof bits);
    bits = number > 0 ? bits + 1 : number < 0 ? bits - 1 : 1;
    memcpy(&number, &bits, sizeof bits);
    return number;
}

/* The float below a number that is not infinite, but for infinity. */
static inline float tribox_float_below(float number)
{
    const float above = tribox_float_above(-number);
    return -above;
}

/* The same of a double. */
static inline double tribox_double_above(double number)
{
    int64_t bits;
    memcpy(&bits, &number, sizeof bits);
    bits = number > 0 ? bits + 1 : number < 0 ? bits - 1 : 1;
    memcpy(&number, &bits, sizeof bits);
    return number;
}

/* What subtracting rounds off a difference, exactly (D. E. Knuth); NaN where the difference is not finite. */
static inline double tribox_lost_by_difference(double from, double less)
{
    const double difference = from - less, of_less = from - difference, of_from = difference + of_less;
    return (from - of_from) + (of_less - less);
}

#endif
