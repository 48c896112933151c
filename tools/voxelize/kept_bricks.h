/* kept_bricks.h - bricks that wait in memory until they are handed on, with the ids of their cells where these have some. */
#ifndef KEPT_BRICKS_H
#define KEPT_BRICKS_H

#include "tile_set.h"

typedef struct kept_brick {
    uint32_t at[3];
    uint64_t bits[8];
} kept_brick;

typedef struct kept_bricks {
    kept_brick *bricks;
    size_t count, room;
    uint32_t *ids; /* one brick's after another's */
    size_t ids_count, ids_room;
} kept_bricks;

/* A tile_sink's take, of kept_bricks. It stops where there is no memory. */
int kept_bricks_take(void *kept, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids);

/* Returns TRIBOX_STOPPED if the sink stopped. */
tribox_status kept_bricks_hand_on(const kept_bricks *kept, const tile_sink *sink);

/* How much they take, counted in bricks. */
static inline size_t kept_bricks_size(const kept_bricks *kept)
{
    return kept->count + kept->ids_count * sizeof *kept->ids / sizeof *kept->bricks;
}

void kept_bricks_free(kept_bricks *kept);

#endif
