/* volume_bytes.c - spreads words to bytes, eight cells at a time. */
#include "volume_bytes.h"

#include "read/little.h"

enum { CHUNK_WORDS = 64 };

/* Bit i of a byte becomes byte i. */
static uint64_t spread(uint64_t byte)
{
    const uint64_t own = (byte * UINT64_C(0x0101010101010101)) & UINT64_C(0x8040201008040201);
    return (own + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
}

static void write_row(FILE *to, const uint64_t *row, uint32_t cells)
{
    unsigned char bytes[64 * CHUNK_WORDS];
    for (uint32_t start = 0; start < cells; start += sizeof bytes) {
        const uint32_t count = cells - start < sizeof bytes ? cells - start : (uint32_t)sizeof bytes;
        for (uint32_t i = 0; i < count; i += 8)
            little_put64(bytes + i, spread(row[(start + i) / 64] >> i % 64 & 0xff));
        fwrite(bytes, 1, count, to);
    }
}

void volume_write_bytes(FILE *to, const voxels *v, progress *bar)
{
    const size_t row_words = voxels_row_words(&v->grid);
    for (uint32_t k = 0; k < v->grid.size[2] && !ferror(to); k++) {
        const uint64_t *layer = voxels_layer(v, k);
        for (uint32_t j = 0; j < v->grid.size[1] && !ferror(to); j++)
            write_row(to, layer + j * row_words, v->grid.size[0]);
        progress_tell(bar, (k + 1.0) / v->grid.size[2]);
    }
}
