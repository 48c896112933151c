/* tiles.c - how many tiles a grid has, and whether it has a share of them. */
#include "base/compiler.h"
#include "tiles.h"

/* The tiles along an axis, 0 of one that has none. */
static size_t tiles_along(uint32_t cells, uint32_t side) { return side ? cells / side + (cells % side != 0) : 0; }

size_t tribox_tile_count(const uint32_t size[3], uint32_t side)
{
    size_t tiles = 1;
    bool is_too_many = false;
    for (int a = 0; a < 3; a++) {
        const size_t along = tiles_along(size[a], side);
        if (!along)
            return 0;
        is_too_many |= tiles > SIZE_MAX / along;
        tiles *= along;
    }
    return is_too_many ? SIZE_MAX : tiles;
}

bool tribox_tiling_make(const uint32_t size[3], const tribox_tiles *share, tribox_tiling *tiling)
{
    const size_t tiles = tribox_tile_count(size, share->side), first = share->first, count = share->count;
    *tiling = (tribox_tiling){.side = share->side, .tiles = tiles, .first = first, .end = first + count};
    for (int a = 0; a < 3; a++) {
        tiling->size[a] = size[a];
        tiling->along[a] = tiles_along(size[a], share->side);
    }
    return share->side && tiles < SIZE_MAX && first <= tiles && count <= tiles - first;
}
