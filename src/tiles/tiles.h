/* tiles.h - the tiles of a grid, and a share of them. */
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

#endif
