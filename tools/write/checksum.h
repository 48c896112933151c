/* checksum.h - the 64-bit checksum of parts and partitions: FNV-1a with words in place of bytes. See tribox(1), FORMATS. */
#ifndef CHECKSUM_H
#define CHECKSUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define CHECKSUM_EMPTY UINT64_C(0xcbf29ce484222325)

/* Each step is a bijection of the sum and of the word: a single changed word always changes it. */
static inline uint64_t checksum_word(uint64_t sum, uint64_t word)
{
    sum = (sum ^ word) * UINT64_C(0x100000001b3);
    return sum ^ sum >> 32;
}

/* Of bytes in words of 64 bits as they lie in memory; zeros fill the last. */
static inline uint64_t checksum_bytes(uint64_t sum, const void *bytes, size_t size)
{
    const unsigned char *const from = bytes;
    for (size_t i = 0; i < size; i += sizeof(uint64_t)) {
        uint64_t word = 0;
        memcpy(&word, from + i, size - i < sizeof word ? size - i : sizeof word);
        sum = checksum_word(sum, word);
    }
    return sum;
}

/*
 * What tells meshes apart: the sum of the checksums of the triangles, and the sum of each checksum times the triangle's number from
 * 0, which tells orders apart. Both are linear, so that those of pieces give those of all.
 */
typedef struct mesh_sums {
    uint64_t coordinates, order;
} mesh_sums;

/* Adds those of a piece, whose first triangle has the number `first`. */
static inline void mesh_sums_add(mesh_sums *to, const mesh_sums *of, uint64_t first)
{
    to->coordinates += of->coordinates;
    to->order += of->order + first * of->coordinates;
}

#endif
