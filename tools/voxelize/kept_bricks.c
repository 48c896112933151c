/* kept_bricks.c - growing rows of bricks and of ids. */
#include "kept_bricks.h"

#include <stdlib.h>
#include <string.h>

#include "console/memory.h"
#include "write/voxels.h"

static bool keep_ids(kept_bricks *k, const uint32_t *ids, size_t cells)
{
    uint32_t *const grown = memory_grow(k->ids, k->ids_count + cells, &k->ids_room, sizeof *ids);
    if (!grown)
        return false;
    k->ids = grown;
    memcpy(k->ids + k->ids_count, ids, cells * sizeof *ids);
    k->ids_count += cells;
    return true;
}

int kept_bricks_take(void *kept, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    kept_bricks *const k = kept;
    kept_brick *const grown = memory_grow(k->bricks, k->count + 1, &k->room, sizeof *grown);
    if (!grown)
        return 1;
    k->bricks = grown;
    if (ids && !keep_ids(k, ids, (size_t)voxels_count(bits, 8)))
        return 1;
    kept_brick *const to = &k->bricks[k->count++];
    memcpy(to->at, at, sizeof to->at);
    memcpy(to->bits, bits, sizeof to->bits);
    return 0;
}

tribox_status kept_bricks_hand_on(const kept_bricks *kept, const tile_sink *sink)
{
    const uint32_t *ids = kept->ids_count ? kept->ids : NULL;
    for (size_t i = 0; i < kept->count; i++) {
        const kept_brick *const b = &kept->bricks[i];
        if (sink->take(sink->data, b->at, b->bits, ids))
            return TRIBOX_STOPPED;
        if (ids)
            ids += voxels_count(b->bits, 8);
    }
    return TRIBOX_OK;
}

void kept_bricks_free(kept_bricks *kept)
{
    free(kept->bricks);
    free(kept->ids);
}
