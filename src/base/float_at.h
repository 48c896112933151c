/*
 * float_at.h - a float at any address, as the interface allows: read as one that is aligned it is undefined, and faults on processors
 * such as 32-bit ARM.
 */
#ifndef TRIBOX_FLOAT_AT_H
#define TRIBOX_FLOAT_AT_H

#include <string.h>

static inline float tribox_float_at(const void *from)
{
    float number;
    memcpy(&number, from, sizeof number);
    return number;
}

#endif
