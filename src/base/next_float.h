/* next_float.h - the floats beside a number. */
#ifndef TRIBOX_NEXT_FLOAT_H
#define TRIBOX_NEXT_FLOAT_H

#include <stdint.h>
#include <string.h>

#include "compiler.h"

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

#endif
