/* mask.c - masks of bits. */
#include "bits.h"
#include "tribox.h"

size_t tribox_mask_words(size_t count) { return tribox_words_of(count); }

size_t tribox_mask_indices(const uint64_t *mask, size_t count, uint32_t *indices)
{
    size_t found = 0;
    for (size_t word = 0; word < tribox_words_of(count); word++) {
        uint64_t left = mask[word];
        if (word == count / 64)
            left &= ~(~UINT64_C(0) << count % 64);
        if (!indices)
            found += tribox_count_bits(left);
        for (; indices && left; left &= left - 1)
            indices[found++] = (uint32_t)(64 * word) + tribox_lowest_bit(left);
    }
    return found;
}
