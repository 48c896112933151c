/* sort_keys.h - the keys of a spatial order, in memory that the caller provides, and the cuts that put them in order. */
#ifndef TRIBOX_SORT_KEYS_H
#define TRIBOX_SORT_KEYS_H

#include "kernel.h"

enum { TRIBOX_PLACE_BYTES = 16 };

/* Place `first` and those after it, of `total` whose streams follow one another. */
static inline tribox_sort_keys tribox_sort_keys_in(void *memory, size_t total, size_t first)
{
    float *const x = (float *)memory + first;
    return (tribox_sort_keys){{x, x + total, x + 2 * total}, (uint32_t *)memory + 3 * total + first};
}

/* How many of `count` places come before their cut: 0 for no cut, where they are one word. */
static inline size_t tribox_keys_before_cut(size_t count)
{
    size_t unit = 64;
    while (unit < (count + 63) / 64)
        unit *= 64;
    return count <= 64 ? 0 : (count / unit + 1) / 2 * unit;
}

/*
 * Cuts places first .. first + count - 1, one at least, down to words, and writes their numbers to the same places of the order.
 * The second part of a cut is never much the greater, so calls nest little more than log2(count) deep.
 */
void tribox_sort_keys_finish(const tribox_kernel *kernel, void *scratch, size_t total, size_t first, size_t count, uint32_t *order);

#endif
