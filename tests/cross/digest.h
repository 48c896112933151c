/* digest.h - FNV-1a, of words as eight bytes each, the lowest first. */
#ifndef TRIBOX_TESTS_DIGEST_H
#define TRIBOX_TESTS_DIGEST_H

#include <stddef.h>
#include <stdint.h>

typedef uint64_t digest;

static const digest digest_start = UINT64_C(0xcbf29ce484222325);

static inline void digest_add(digest *d, const uint64_t *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (int shift = 0; shift < 64; shift += 8)
            *d = (*d ^ (words[i] >> shift & 0xff)) * UINT64_C(0x100000001b3);
}

#endif
