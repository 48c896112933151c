/* volume_raw.c - the bits as they lie in memory. */
#include "read/little.h"
#include "volume.h"

enum { CHUNK = 512 };

static void write_words(FILE *to, const uint64_t *words, size_t count)
{
    unsigned char chunk[8 * CHUNK];
    for (size_t w = 0; w < count && !ferror(to);) {
        size_t filled = 0;
        for (; filled < CHUNK && w < count; filled++)
            little_put64(chunk + 8 * filled, words[w++]);
        fwrite(chunk, 8, filled, to);
    }
}

void volume_write_raw(FILE *to, const voxels *v, progress *bar)
{
    for (uint32_t k = 0; k < v->grid.size[2] && !ferror(to); k++) {
        write_words(to, voxels_layer(v, k), voxels_layer_words(&v->grid));
        progress_tell(bar, (k + 1.0) / v->grid.size[2]);
    }
}
