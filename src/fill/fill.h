/* fill.h - what both ways of filling share: the rows of a grid, and a bit for each. */
#ifndef TRIBOX_FILL_H
#define TRIBOX_FILL_H

#include <stdbool.h>
#include <string.h>

#include "base/bits.h"
#include "tribox.h"

/* Rows of cells along x, of `words` words each, j + k * size[1] for row (j, k). */
typedef struct tribox_rows {
    size_t words, count;
    uint64_t last; /* the bits that a row's last word has cells for */
} tribox_rows;

tribox_rows tribox_rows_of(const uint32_t size[3]);

/* Cells on every axis, and no more than 2^31 words. */
bool tribox_fill_is_served(const uint32_t size[3]);

/* Two bits for each row, one after those of all rows, in scratch that the caller provides: all of them clear. */
uint64_t *tribox_fill_row_bits(void *scratch, const tribox_rows *rows);

/* The bits that word w of a row has cells for. */
static inline uint64_t tribox_row_mask(const tribox_rows *rows, size_t w)
{
    return w + 1 == rows->words ? rows->last : ~UINT64_C(0);
}

/* Bits of a word of which most have none or all. */
static inline size_t tribox_count_most(uint64_t word) { return !word ? 0 : !~word ? 64 : tribox_count_bits(word); }

#endif
