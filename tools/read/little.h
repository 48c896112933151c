/* little.h - numbers as little-endian bytes, on any machine. */
#ifndef LITTLE_H
#define LITTLE_H

#include <stdint.h>

static inline void little_put32(unsigned char *to, uint32_t number)
{
    for (int b = 0; b < 4; b++)
        to[b] = (unsigned char)(number >> 8 * b);
}

static inline void little_put64(unsigned char *to, uint64_t number)
{
    little_put32(to, (uint32_t)number);
    little_put32(to + 4, (uint32_t)(number >> 32));
}

static inline uint32_t little_get32(const unsigned char *from)
{
    return (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

static inline uint64_t little_get64(const unsigned char *from)
{
    return little_get32(from) | (uint64_t)little_get32(from + 4) << 32;
}

#endif
