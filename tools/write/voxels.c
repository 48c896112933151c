/* voxels.c - finds layers among slabs, and counts cells. */
#include "voxels.h"

const uint64_t *voxels_layer(const voxels *v, uint32_t k)
{
    size_t low = 0, high = v->slabs;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (v->slab[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return v->slab[low].bits + (size_t)(k - v->slab[low].first) * voxels_layer_words(&v->grid);
}

uint64_t voxels_count(const uint64_t *words, size_t count)
{
    enum { WORDS_MAX = 1 << 26 }; /* the library counts up to 2^32 bits at once */
    uint64_t bits = 0;
    for (size_t w = 0; w < count; w += WORDS_MAX)
        bits += tribox_mask_indices(words + w, 64 * (count - w < WORDS_MAX ? count - w : WORDS_MAX), NULL);
    return bits;
}

uint64_t voxels_occupied(const voxels *v)
{
    uint64_t cells = 0;
    for (size_t s = 0; s < v->slabs; s++)
        cells += voxels_count(v->slab[s].bits, v->slab[s].layers * voxels_layer_words(&v->grid));
    return cells;
}

size_t voxels_layer_words(const tribox_grid *grid) { return tribox_grid_row_words(grid) * grid->size[1]; }
