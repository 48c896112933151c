/* fill.c - what both ways of filling share: which grids are served, their rows, and scratch for these. */
#include "fill.h"

#include "grid/grid_cells.h"

tribox_rows tribox_rows_of(const uint32_t size[3])
{
    return (tribox_rows){
        .words = tribox_words_of(size[0]), .count = (size_t)size[1] * size[2], .last = ~UINT64_C(0) >> (63 - (size[0] - 1) % 64)};
}

bool tribox_fill_is_served(const uint32_t size[3]) { return size[0] && size[1] && size[2] && tribox_fits_one_call(size); }

size_t tribox_fill_bytes(const uint32_t size[3])
{
    const uint64_t rows = (uint64_t)size[1] * size[2], bytes = (2 * (rows / 64 + 1) + 1) * sizeof(uint64_t);
    return bytes > SIZE_MAX ? SIZE_MAX : (size_t)bytes;
}

uint64_t *tribox_fill_row_bits(void *scratch, const tribox_rows *rows)
{
    const size_t off = (uintptr_t)scratch % sizeof(uint64_t);
    uint64_t *const bits = (uint64_t *)(void *)((char *)scratch + (off ? sizeof(uint64_t) - off : 0));
    memset(bits, 0, 2 * tribox_words_of(rows->count) * sizeof *bits);
    return bits;
}
