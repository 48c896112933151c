/* kept_numbers.c - a bit for each number, and counts of bits: 12 bytes for 64 numbers. */
#include "kept_numbers.h"

#include <inttypes.h>
#include <stdlib.h>

#include "console/message.h"

int kept_numbers_make(const char *path, uint64_t count, kept_numbers *k)
{
    const uint64_t words = count / 64 + 1;
    *k = (kept_numbers){.count = count};
    if (count <= UINT32_MAX) {
        k->bits = calloc((size_t)words, sizeof *k->bits);
        k->before = calloc((size_t)words, sizeof *k->before);
    }
    return k->bits && k->before ? EXIT_CODE_OK
                                : message_failure("%s: out of memory for the numbers of %" PRIu64 " vertices", path, count);
}

void kept_numbers_free(kept_numbers *k)
{
    free(k->bits);
    free(k->before);
    *k = (kept_numbers){.bits = NULL};
}

static unsigned count_bits(uint64_t word) { return (unsigned)__builtin_popcountll(word); }

void kept_numbers_count(kept_numbers *k)
{
    k->kept = 0;
    for (uint64_t w = 0; w < k->count / 64 + 1; w++) {
        k->before[w] = (uint32_t)k->kept;
        k->kept += count_bits(k->bits[w]);
    }
}

uint64_t kept_numbers_new(const kept_numbers *k, uint64_t number)
{
    const uint64_t below = k->bits[number / 64] & ((UINT64_C(1) << number % 64) - 1);
    return k->before[number / 64] + count_bits(below);
}
