/* volume_raw.c - the bits as they lie in memory. */
#include "read/little.h"
#include "sparse_out.h"
#include "volume.h"

enum { CHUNK = 512 };

static void write_chunk(sparse_out *to, const uint64_t *words, size_t count)
{
    uint64_t any = 0;
    for (size_t w = 0; w < count; w++)
        any |= words[w];
    if (!any) {
        sparse_zeros(to, 8 * count);
        return;
    }
    unsigned char *const bytes = sparse_room(to, 8 * count);
    for (size_t w = 0; w < count; w++)
        little_put64(bytes + 8 * w, words[w]);
}

void volume_write_raw(FILE *stream, const voxels *v, progress *bar)
{
    sparse_out to;
    const size_t words = voxels_layer_words(&v->grid);
    sparse_start(&to, stream);
    for (uint32_t k = 0; k < v->grid.size[2] && !ferror(stream); k++) {
        const uint64_t *const layer = voxels_layer(v, k);
        for (size_t w = 0; w < words; w += CHUNK)
            write_chunk(&to, layer + w, words - w < CHUNK ? words - w : CHUNK);
        progress_tell(bar, (k + 1.0) / v->grid.size[2]);
    }
    sparse_end(&to);
}
