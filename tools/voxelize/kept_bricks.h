/* kept_bricks.h - bricks that wait in memory until they are handed on. */
#ifndef KEPT_BRICKS_H
#define KEPT_BRICKS_H

#include "tribox.h"

typedef struct kept_brick {
    uint32_t at[3];
    uint64_t bits[8];
} kept_brick;

typedef struct kept_bricks {
    kept_brick *bricks; /* to be freed */
    size_t count, room;
} kept_bricks;

/* A tribox_sink's take, of kept_bricks. It stops where there is no memory. */
int kept_bricks_take(void *kept, const uint32_t at[3], const uint64_t bits[8]);

/* Returns TRIBOX_STOPPED if the sink stopped. */
tribox_status kept_bricks_hand_on(const kept_bricks *kept, const tribox_sink *sink);

#endif
