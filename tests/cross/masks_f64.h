/* masks_f64.h - digests, and those of the answers about doubles. Ends the program with a message where kernels differ. */
#ifndef TRIBOX_TESTS_MASKS_F64_H
#define TRIBOX_TESTS_MASKS_F64_H

#include "doubles/scenes_f64.h"

/* FNV-1a, of words as eight bytes each, the lowest first. */
typedef uint64_t digest;

static const digest digest_start = UINT64_C(0xcbf29ce484222325);

static inline void digest_add(digest *d, const uint64_t *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (int shift = 0; shift < 64; shift += 8)
            *d = (*d ^ (words[i] >> shift & 0xff)) * UINT64_C(0x100000001b3);
}

typedef struct digests_f64 {
    digest drawn, exact, axes, meshes; /* what is asked; EXACT on all axes and on fewer; other layouts, and local streams */
} digests_f64;

digests_f64 digests_f64_of(const scene_f64 *scene, uint64_t seed, size_t batches);

#endif
