/* place.c - sorts triangles along a Morton curve. */
#include "place.h"

#include <stdlib.h>
#include <string.h>

typedef struct keyed {
    uint64_t key;
    triangle t;
} keyed;

static int by_key(const void *a, const void *b)
{
    const uint64_t p = ((const keyed *)a)->key, q = ((const keyed *)b)->key;
    return (p > q) - (p < q);
}

/* The bits of the centroid's cell on the three axes, interleaved: x lowest. */
static uint64_t morton_code(const float t[3][3], float reach)
{
    uint64_t code = 0;
    for (int a = 0; a < 3; a++) {
        const float middle = (t[0][a] + t[1][a] + t[2][a]) / 3;
        const unsigned cell = (unsigned)((middle / reach + 1) * 511.5f);
        for (int bit = 0; bit < 10; bit++)
            code |= (uint64_t)(cell >> bit & 1) << (3 * bit + a);
    }
    return code;
}

bool place_sort(triangle *triangles, size_t count, float reach)
{
    keyed *const order = malloc(count * sizeof *order);
    if (!order)
        return false;
    for (size_t i = 0; i < count; i++) {
        memcpy(order[i].t, triangles[i], sizeof(triangle));
        order[i].key = morton_code((const float(*)[3])triangles[i], reach);
    }
    qsort(order, count, sizeof *order, by_key);
    for (size_t i = 0; i < count; i++)
        memcpy(triangles[i], order[i].t, sizeof(triangle));
    free(order);
    return true;
}
