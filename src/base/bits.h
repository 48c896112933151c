/* bits.h - words of 64. */
#ifndef TRIBOX_BITS_H
#define TRIBOX_BITS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "compiler.h"

/* How many words have a bit for each of `count` things. */
static inline size_t tribox_words_of(size_t count) { return count / 64 + (count % 64 != 0); }

/* Without an instruction in parallel within the word: pairs of bits, nibbles, bytes, and a product that adds up the bytes. */
static inline unsigned tribox_count_bits(uint64_t word)
{
#if defined(__POPCNT__) || (defined(TRIBOX_POPCNT) && (defined(__GNUC__) || defined(__clang__)))
    return (unsigned)__builtin_popcountll(word);
#else
    word -= word >> 1 & UINT64_C(0x5555555555555555);
    word = (word & UINT64_C(0x3333333333333333)) + (word >> 2 & UINT64_C(0x3333333333333333));
    word = (word + (word >> 4)) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    return (unsigned)(word * UINT64_C(0x0101010101010101) >> 56);
#endif
}

/* Sets bits of a word. Returns how many of them were not set before. */
static inline unsigned tribox_set_bits(uint64_t *word, uint64_t bits)
{
    const uint64_t before = *word;
    *word = before | bits;
    return tribox_count_bits(bits & ~before);
}

/* The bytes of a word, the lowest first. */
static inline void tribox_put_bytes(uint8_t *to, uint64_t word)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    memcpy(to, &word, sizeof word);
}

/* The index of the lowest bit of a word that has one. */
static inline unsigned tribox_lowest_bit(uint64_t word)
{
#if defined(__GNUC__) || defined(__clang__)
    return (unsigned)__builtin_ctzll(word);
#else
    return tribox_count_bits((word & (~word + 1)) - 1);
#endif
}

/* How many bits a word has up to its highest: 0 of 0. */
static inline unsigned tribox_bit_length(uint64_t word)
{
#if defined(__GNUC__) || defined(__clang__)
    return word ? 64 - (unsigned)__builtin_clzll(word) : 0;
#else
    unsigned length = 0;
    for (; word; word >>= 1)
        length++;
    return length;
#endif
}

#endif
