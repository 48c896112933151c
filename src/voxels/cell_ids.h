/*
 * cell_ids.h - for each cell the lowest number of a triangle that overlaps it, beside its bit.
 *
 * A number counts where the bit is set, and is not told from others elsewhere: nothing has to be cleared. Numbers of cells that are
 * being set are lowered before their bits are, or with them. In whatever order triangles come, the lowest is left.
 */
#ifndef TRIBOX_CELL_IDS_H
#define TRIBOX_CELL_IDS_H

#include "base/bits.h"

/* Those of the cells of a window, by z, then y, then x. */
typedef struct tribox_cell_ids {
    uint32_t *of;       /* NULL where none are asked for */
    uint32_t first;     /* added to the number of a triangle */
    uint32_t row_words; /* of the bits, which have a gap after each row that ends within a word: */
    uint32_t gap;       /* so many bits */
} tribox_cell_ids;

/* Where those of a word of bits begin. */
static inline uint32_t *tribox_ids_of_word(const tribox_cell_ids *ids, uint32_t word)
{
    return ids->of + 64 * (size_t)word - (ids->gap ? (size_t)(word / ids->row_words) * ids->gap : 0);
}

/* Of the cells that `bits` says, of which those of `before` have a number. */
static inline void tribox_lower_ids(uint32_t *ids, uint64_t before, uint64_t bits, uint32_t id)
{
    for (; bits; bits &= bits - 1) {
        const unsigned n = tribox_lowest_bit(bits);
        const uint32_t old = ids[n] | ((uint32_t)(before >> n & 1) - 1);
        ids[n] = old < id ? old : id;
    }
}

/* Of cells that follow each other, 64 at most: bit n of `before` is that of the n-th. */
static inline void tribox_lower_run(uint32_t *ids, uint64_t before, int64_t count, uint32_t id)
{
    for (int64_t n = 0; n < count; n++, before >>= 1) {
        const uint32_t old = ids[n] | ((uint32_t)(before & 1) - 1);
        ids[n] = old < id ? old : id;
    }
}

/* Of cells `first` to `last` of a row, counted from the first bit of word `row`. */
static inline void tribox_lower_row(const tribox_cell_ids *ids, const uint64_t *occupied, size_t row, int64_t first, int64_t last,
                                    uint32_t id)
{
    uint32_t *const to = tribox_ids_of_word(ids, (uint32_t)row);
    for (int64_t at = first, end; at <= last; at = end) {
        end = at / 64 < last / 64 ? (at / 64 + 1) * 64 : last + 1;
        tribox_lower_run(to + at, occupied[row + (size_t)(at / 64)] >> at % 64, end - at, id);
    }
}

/* Of `count` cells, bit `bit` of each of as many words, those of rows that follow each other. */
static inline void tribox_lower_column(const tribox_cell_ids *ids, const uint64_t *occupied, size_t word, unsigned bit,
                                       int64_t count, uint32_t id)
{
    const size_t step = 64 * (size_t)ids->row_words - ids->gap;
    uint32_t *to = tribox_ids_of_word(ids, (uint32_t)word) + bit;
    for (int64_t n = 0; n < count; n++, word += ids->row_words, to += step) {
        const uint32_t old = *to | ((uint32_t)(occupied[word] >> bit & 1) - 1);
        *to = old < id ? old : id;
    }
}

#endif
