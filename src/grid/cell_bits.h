/* cell_bits.h - sets the bits of cells, a row or a column at a time. */
#ifndef TRIBOX_CELL_BITS_H
#define TRIBOX_CELL_BITS_H

#include <stddef.h>

#include "base/bits.h"

/* Sets cells first to last of a row, a word at a time. Returns how many were not set before. */
static inline size_t tribox_set_cells(uint64_t *row, int64_t first, int64_t last)
{
    const uint64_t full = ~UINT64_C(0), from = full << first % 64, to = full >> (63 - last % 64);
    uint64_t *word = row + first / 64, *const end = row + last / 64;
    if (word == end)
        return tribox_set_bits(word, from & to);
    size_t set = tribox_set_bits(word, from);
    while (++word < end)
        if (*word != full)
            set += tribox_set_bits(word, full);
    return set + tribox_set_bits(word, to);
}

/*
 * Sets one bit in each of `count` words, `step` apart. Eight are loaded before any is stored, as a load that lies a multiple of
 * 4096 bytes after a store in flight waits for it; and nothing is stored where nothing is new. Returns how many were not set
 * before.
 */
static inline size_t tribox_set_column(uint64_t *word, size_t step, int64_t count, uint64_t bit)
{
    size_t set = 0;
    for (; count >= 8; count -= 8, word += 8 * step) {
        uint64_t before[8], all = bit;
        for (int n = 0; n < 8; n++) {
            before[n] = word[(size_t)n * step];
            all &= before[n];
        }
        if (all)
            continue;
        for (int n = 0; n < 8; n++) {
            word[(size_t)n * step] = before[n] | bit;
            set += !(before[n] & bit);
        }
    }
    for (; count > 0; count--, word += step)
        set += tribox_set_bits(word, bit);
    return set;
}

#endif
