/* masks_f64.h - digests of the answers about doubles. Ends the program with a message where kernels differ. */
#ifndef TRIBOX_TESTS_MASKS_F64_H
#define TRIBOX_TESTS_MASKS_F64_H

#include "digest.h"
#include "doubles/scenes_f64.h"

typedef struct digests_f64 {
    digest drawn, exact, axes, meshes; /* what is asked; EXACT on all axes and on fewer; other layouts, and local streams */
} digests_f64;

digests_f64 digests_f64_of(const scene_f64 *scene, uint64_t seed, size_t batches);

#endif
