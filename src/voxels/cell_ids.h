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
    bool has_room;      /* nobody else has the numbers before and after them, up to a vector */
} tribox_cell_ids;

/* Where those of a word of bits begin: the number of its first cell. */
static inline size_t tribox_ids_at_word(const tribox_cell_ids *ids, uint32_t word)
{
    return 64 * (size_t)word - (ids->gap ? (size_t)(word / ids->row_words) * ids->gap : 0);
}
static inline uint32_t *tribox_ids_of_word(const tribox_cell_ids *ids, uint32_t word)
{
    return ids->of + tribox_ids_at_word(ids, word);
}

/*
 * As many at once as a vector has, where it has eight at least: runs are mostly short, and where a loop over their cells ends,
 * nobody foresees. Vectors lie at multiples of their length, so that what one has written comes whole to the next.
 */
#if !defined(__GNUC__) && !defined(__clang__)
#define TRIBOX_IDS_AT_ONCE 0
#elif defined(TRIBOX_VECTOR_BYTES)
#define TRIBOX_IDS_AT_ONCE (TRIBOX_VECTOR_BYTES / 4)
#else
#define TRIBOX_IDS_AT_ONCE 0
#endif

/* Of the cells that the lowest bits say, of which those of `before` have a number. */
static inline void tribox_lower_some(uint32_t *ids, uint64_t before, uint64_t bits, uint32_t id)
{
#if TRIBOX_IDS_AT_ONCE
    typedef uint32_t vector __attribute__((vector_size(4 * TRIBOX_IDS_AT_ONCE)));
    typedef vector in_memory __attribute__((aligned(4), may_alias));
    static const uint32_t bit_of[16] = {1,      1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                                        1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
    const vector bit = *(const in_memory *)bit_of, own = *(const in_memory *)ids, none = {0};
    const vector has_none = (vector)((bit & (uint32_t)before) == 0), is_asked = (vector)((bit & (uint32_t)bits) != 0);
    const vector is_greater = (vector)((own | has_none) > id) & is_asked;
    *(in_memory *)ids = (is_greater & (none + id)) | (~is_greater & own);
#else
    (void)ids, (void)before, (void)bits, (void)id;
#endif
}

/* Of the cells that `bits` says. */
static inline void tribox_lower_ids(const tribox_cell_ids *of, uint32_t *ids, uint64_t before, uint64_t bits, uint32_t id)
{
    const unsigned some = TRIBOX_IDS_AT_ONCE;
    if (some && of->has_room) {
        for (unsigned n; bits; bits &= ~(((UINT64_C(1) << some) - 1) << n)) {
            n = tribox_lowest_bit(bits) & ~(some - 1);
            tribox_lower_some(ids + n, before >> n, bits >> n, id);
        }
        return;
    }
    for (; bits; bits &= bits - 1) {
        const unsigned n = tribox_lowest_bit(bits);
        const uint32_t old = ids[n] | ((uint32_t)(before >> n & 1) - 1);
        ids[n] = old < id ? old : id;
    }
}

/* Of cells that follow each other, at least one and 64 at most, none in another word: bit n of `before` is that of the n-th. */
static inline void tribox_lower_run(const tribox_cell_ids *of, uint32_t *ids, uint64_t before, int64_t count, uint32_t id)
{
    const unsigned some = TRIBOX_IDS_AT_ONCE;
    if (some && of->has_room) {
        const unsigned from = (unsigned)((uintptr_t)ids / sizeof *ids) & (some - 1);
        tribox_lower_some(ids - from, before << from, ~UINT64_C(0) >> (64 - count) << from, id);
        for (int64_t n = some - from; n < count; n += some)
            tribox_lower_some(ids + n, before >> n, ~UINT64_C(0) >> (64 - (count - n)), id);
        return;
    }
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
        tribox_lower_run(ids, to + at, occupied[row + (size_t)(at / 64)] >> at % 64, end - at, id);
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
