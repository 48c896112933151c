/* little.h - numbers as little-endian bytes, on any machine. */
#ifndef LITTLE_H
#define LITTLE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

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

/* Numbers of 4 or 8 bytes in place: from the order of the machine to little-endian, or back. */
static inline void little_turn(void *numbers, size_t count, size_t bytes)
{
    unsigned char *number = numbers;
    for (size_t n = 0; n < count; n++, number += bytes) {
        const uint64_t turned = bytes == sizeof(uint64_t) ? little_get64(number) : 0;
        const uint32_t narrow = bytes == sizeof(uint32_t) ? little_get32(number) : 0;
        memcpy(number, bytes == sizeof turned ? (const void *)&turned : &narrow, bytes);
    }
}

#endif
