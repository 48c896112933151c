/* volume_bytes.c - spreads words to bytes, eight cells at a time, and leaves out empty rows. */
#include "volume_bytes.h"

#include <string.h>

#include "read/little.h"
#include "sparse_out.h"

/* Bit i of a byte becomes byte i. */
static uint64_t spread(uint64_t byte)
{
    const uint64_t own = (byte * UINT64_C(0x0101010101010101)) & UINT64_C(0x8040201008040201);
    return (own + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
}

static void write_word(sparse_out *to, uint64_t word, size_t cells)
{
    unsigned char bytes[64];
    for (unsigned i = 0; i < 64; i += 8)
        little_put64(bytes + i, spread(word >> i & 0xff));
    memcpy(sparse_room(to, cells), bytes, cells);
}

static bool is_empty(const uint64_t *words, size_t count)
{
    uint64_t any = 0;
    for (size_t w = 0; w < count; w++)
        any |= words[w];
    return !any;
}

static void write_row(sparse_out *to, const uint64_t *row, uint32_t cells)
{
    for (uint32_t start = 0; start < cells; start += 64) {
        const size_t count = cells - start < 64 ? cells - start : 64;
        if (row[start / 64])
            write_word(to, row[start / 64], count);
        else
            sparse_zeros(to, count);
    }
}

void volume_write_bytes(FILE *stream, const voxels *v, progress *bar)
{
    sparse_out to;
    const uint32_t *const size = v->grid.size;
    const size_t row_words = voxels_row_words(&v->grid);
    sparse_start(&to, stream);
    for (uint32_t k = 0; k < size[2] && !ferror(stream); k++) {
        const uint64_t *row = voxels_layer(v, k);
        for (uint32_t j = 0; j < size[1] && !ferror(stream); j++, row += row_words) {
            if (is_empty(row, row_words))
                sparse_zeros(&to, size[0]);
            else
                write_row(&to, row, size[0]);
        }
        progress_tell(bar, (k + 1.0) / size[2]);
    }
    sparse_end(&to);
}
