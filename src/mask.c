/* mask.c - masks of bits. */
#include "bits.h"
#include "tribox.h"

size_t tribox_mask_words(size_t count) { return count / 64 + (count % 64 != 0); }

size_t tribox_mask_indices(const uint64_t *mask, size_t count, uint32_t *indices)
{
    size_t found = 0;
    for (size_t first = 0; first < count; first += 64) {
        uint64_t left = mask[first / 64];
        if (count - first < 64)
            left &= ~(~UINT64_C(0) << (count - first));
        if (!indices)
            found += tribox_count_bits(left);
        for (; indices && left; left &= left - 1)
            indices[found++] = (uint32_t)first + tribox_lowest_bit(left);
    }
    return found;
}
