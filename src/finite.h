/* finite.h - neither NaN nor infinite, from the bits: a comparison could raise flags, or trap, in the caller's environment. */
#ifndef TRIBOX_FINITE_H
#define TRIBOX_FINITE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static inline bool tribox_is_finite(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return (bits & 0x7f800000u) != 0x7f800000u;
}

/* Whether all nine coordinates of a triangle are finite. */
static inline bool tribox_triangle_is_finite(const float u[3][3])
{
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            if (!tribox_is_finite(u[j][a]))
                return false;
    return true;
}

#endif
