/* morton_order.c - keys of places, sorted by their digits. */
#include "morton_order.h"

#include <math.h>
#include <stdlib.h>

enum { AXIS_BITS = 16, KEY_BITS = 3 * AXIS_BITS, DIGIT_BITS = 12, DIGITS = 1 << DIGIT_BITS };

typedef struct keyed {
    uint64_t key;
    uint32_t triangle;
} keyed;

/* 16 bits, two zeros before each. */
static uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 32) & UINT64_C(0x001f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x001f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    return (x | x << 2) & UINT64_C(0x1249249249249249);
}

static uint64_t key_of(const tribox_soup *soup, size_t i, const tribox_box *bounds, double scale)
{
    const float *const *const streams[3] = {soup->x, soup->y, soup->z};
    uint64_t key = 0;
    for (int a = 0; a < 3; a++) {
        const float u = streams[a][0][i], v = streams[a][1][i], w = streams[a][2][i];
        const double twice = (double)fminf(fminf(u, v), w) + (double)fmaxf(fmaxf(u, v), w);
        key |= spread_bits((uint64_t)((twice / 2 - (double)bounds->lo[a]) * scale)) << a;
    }
    return key;
}

/* One digit, the order of equal ones kept. */
static void sort_by_digit(const keyed *from, keyed *to, size_t count, int shift)
{
    static size_t place[DIGITS];
    for (size_t d = 0; d < DIGITS; d++)
        place[d] = 0;
    for (size_t i = 0; i < count; i++)
        place[from[i].key >> shift & (DIGITS - 1)]++;
    for (size_t d = 0, at = 0; d < DIGITS; d++) {
        const size_t here = place[d];
        place[d] = at;
        at += here;
    }
    for (size_t i = 0; i < count; i++)
        to[place[from[i].key >> shift & (DIGITS - 1)]++] = from[i];
}

bool morton_order(const tribox_soup *soup, const tribox_box *bounds, uint32_t *order)
{
    const size_t count = soup->count;
    keyed *const storage = malloc(2 * count * sizeof *storage), *from = storage, *to = storage + count;
    double extent = 0;
    if (!storage)
        return false;
    for (int a = 0; a < 3; a++)
        extent = fmax(extent, (double)bounds->hi[a] - (double)bounds->lo[a]);
    const double scale = extent > 0 ? ((1 << AXIS_BITS) - 1) / extent : 0;
    for (size_t i = 0; i < count; i++)
        from[i] = (keyed){key_of(soup, i, bounds, scale), (uint32_t)i};
    for (int shift = 0; shift < KEY_BITS; shift += DIGIT_BITS) {
        sort_by_digit(from, to, count, shift);
        keyed *const sorted = to;
        to = from;
        from = sorted;
    }
    for (size_t i = 0; i < count; i++)
        order[i] = from[i].triangle;
    free(storage);
    return true;
}
