/* voxels.c - finds layers among slabs, counts cells, and tells whether there is room for them. */
#include "voxels.h"

#include <math.h>
#include <string.h>

#include "console/memory.h"
#include "console/message.h"

static const voxels_slab *slab_of(const voxels *v, uint32_t k)
{
    size_t low = 0, high = v->slabs;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (v->slab[middle].first <= k)
            low = middle;
        else
            high = middle;
    }
    return &v->slab[low];
}

static size_t words_before(const voxels *v, const voxels_slab *slab, uint32_t k)
{
    return (size_t)(k - slab->first) * voxels_layer_words(&v->grid);
}

const uint64_t *voxels_layer(const voxels *v, uint32_t k)
{
    const voxels_slab *const slab = slab_of(v, k);
    return slab->bits + words_before(v, slab, k);
}

const uint64_t *voxels_layer_inside(const voxels *v, uint32_t k)
{
    const voxels_slab *const slab = slab_of(v, k);
    return slab->inside ? slab->inside + words_before(v, slab, k) : NULL;
}

bool voxels_have_labels(const voxels *v) { return v->slabs && v->slab[0].inside; }

uint32_t voxels_layers_from(const voxels *v, uint32_t k)
{
    const voxels_slab *const slab = slab_of(v, k);
    return slab->layers - (k - slab->first);
}

/* Of so few words that no byte of the sum overflows: first pairs of bits are added, then fours, then bytes. */
static uint64_t count_few(const uint64_t *words, size_t count)
{
    const uint64_t twos = UINT64_C(0x5555555555555555), fours = UINT64_C(0x3333333333333333), bytes = UINT64_C(0x0f0f0f0f0f0f0f0f);
    uint64_t sum = 0;
    for (size_t w = 0; w < count; w++) {
        const uint64_t pairs = words[w] - (words[w] >> 1 & twos), nibbles = (pairs & fours) + (pairs >> 2 & fours);
        sum += (nibbles + (nibbles >> 4)) & bytes;
    }
    const uint64_t doubled = (sum & UINT64_C(0x00ff00ff00ff00ff)) + (sum >> 8 & UINT64_C(0x00ff00ff00ff00ff));
    return doubled * UINT64_C(0x0001000100010001) >> 48;
}

uint64_t voxels_count(const uint64_t *words, size_t count)
{
    enum { FEW = 8, WORDS_MAX = 1 << 26 }; /* the library counts up to 2^32 bits at once */
    uint64_t bits = 0;
    if (count <= FEW)
        return count_few(words, count); /* a brick, of which there are many */
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

size_t voxels_row_words(const tribox_grid *grid) { return tribox_mask_words(grid->size[0]); }

size_t voxels_layer_words(const tribox_grid *grid) { return voxels_row_words(grid) * grid->size[1]; }

bool voxels_are_shifted(const voxels *v) { return v->shift[0] != 0 || v->shift[1] != 0 || v->shift[2] != 0; }

const char *voxels_difference(const voxels *one, const voxels *other)
{
    const tribox_grid *const a = &one->grid, *const b = &other->grid;
    if (memcmp(a->origin, b->origin, sizeof a->origin) || memcmp(a->cell, b->cell, sizeof a->cell) ||
        memcmp(a->size, b->size, sizeof a->size))
        return "grid";
    return memcmp(one->shift, other->shift, sizeof one->shift) ? "shift" : NULL;
}

bool voxels_are_served(const tribox_grid *grid, const tribox_options *options)
{
    const tribox_soup nothing = {.count = 0};
    const tribox_window one = {{0, 0, 0}, {1, 1, 1}};
    uint64_t word = 0;
    return !tribox_voxelize(&nothing, grid, &one, options, &word, NULL);
}

int voxels_check_words(const tribox_grid *grid, const char *instead)
{
    static const double words_max = 0x1p31;
    char bytes[16];
    const double words = ceil(grid->size[0] / 64.0) * grid->size[1] * grid->size[2];
    if (words <= words_max)
        return EXIT_CODE_OK;
    return message_failure("a grid of %u x %u x %u cells takes %s, a bit per cell; the most is 16.0 GiB: %s", grid->size[0],
                           grid->size[1], grid->size[2], memory_text(words < 0x1p60 ? (uint64_t)(8 * words) : UINT64_MAX, bytes),
                           instead);
}

int voxels_check_memory(const tribox_grid *grid, uint64_t bytes, const char *instead)
{
    char needed[16], there[16];
    const uint64_t available = memory_available();
    if (bytes <= available)
        return EXIT_CODE_OK;
    return message_failure("%u x %u x %u cells take %s of memory here and %s are available: %s", grid->size[0], grid->size[1],
                           grid->size[2], memory_text(bytes, needed), memory_text(available, there), instead);
}
