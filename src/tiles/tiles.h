/* tiles.h - the tiles of a grid, a share of them, and where their lists begin. */
#ifndef TRIBOX_TILES_H
#define TRIBOX_TILES_H

#include <stdbool.h>

#include "tribox.h"

typedef struct tribox_tiling {
    uint32_t size[3];  /* of the grid, in cells */
    uint32_t side;     /* cells of a tile along each axis, where the grid does not cut it */
    size_t along[3];   /* tiles along each axis */
    size_t tiles;      /* in all */
    size_t first, end; /* the share: tiles first .. end - 1 */
} tribox_tiling;

/* False if there is no such share. */
bool tribox_tiling_make(const uint32_t size[3], const tribox_tiles *share, tribox_tiling *tiling);

/*
 * Each list is counted in the number after its own; their sums are where lists begin. Whether a list of all can be addressed: with
 * addresses of 32 bits a few thousand triangles can be in a million tiles each.
 */
static inline bool tribox_sum_counts(size_t *starts, size_t tiles)
{
    bool fits = true;
    starts[0] = 0;
    for (size_t t = 0; t < tiles && fits; t++) {
        fits = starts[t + 1] <= SIZE_MAX / sizeof(uint32_t) - starts[t];
        starts[t + 1] += starts[t];
    }
    return fits;
}

#endif
