/* tame.h - numbers of which products of three neither overflow nor underflow in double: zero, and what is from 2^-200 to 2^200. */
#ifndef TRIBOX_EXACT_TAME_H
#define TRIBOX_EXACT_TAME_H

#include <math.h>
#include <stdbool.h>

#define TRIBOX_TAME_LEAST 0x1p-200
#define TRIBOX_TAME_MOST 0x1p200

static inline bool tribox_is_tame(double number)
{
    const double size = fabs(number);
    return size == 0 || (size >= TRIBOX_TAME_LEAST && size <= TRIBOX_TAME_MOST);
}

#endif
