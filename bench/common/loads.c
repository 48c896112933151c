/* loads.c - reads, and nothing else. */
#include "loads.h"

#include <string.h>

/* Integers, since the compiler may not reorder a sum of floats, and so may not put it into vectors. */
static inline uint32_t bits_at(const float *stream, size_t i)
{
    uint32_t bits;
    memcpy(&bits, stream + i, sizeof bits);
    return bits;
}

uint32_t loads_all(const tribox_soup *soup)
{
    const float *const x0 = soup->x[0], *const x1 = soup->x[1], *const x2 = soup->x[2];
    const float *const y0 = soup->y[0], *const y1 = soup->y[1], *const y2 = soup->y[2];
    const float *const z0 = soup->z[0], *const z1 = soup->z[1], *const z2 = soup->z[2];
    uint32_t all = 0;
    for (size_t i = 0; i < soup->count; i++)
        all ^= bits_at(x0, i) ^ bits_at(x1, i) ^ bits_at(x2, i) ^ bits_at(y0, i) ^ bits_at(y1, i) ^ bits_at(y2, i) ^
               bits_at(z0, i) ^ bits_at(z1, i) ^ bits_at(z2, i);
    return all;
}

uint32_t loads_words(const void *words, size_t count)
{
    uint32_t all = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, (const char *)words + 4 * i, sizeof word);
        all ^= word;
    }
    return all;
}
