/* brick_sink.h - the bricks of a tile, handed to a sink. */
#ifndef TRIBOX_BRICK_SINK_H
#define TRIBOX_BRICK_SINK_H

#include <stdbool.h>

#include "tribox.h"

/* A sink, and the cells that it was handed. */
typedef struct tribox_hand {
    tribox_sink *sink;
    void *data;
    size_t cells;
} tribox_hand;

/*
 * Hands on the bricks of a window of bits that are not empty, by z, then y, then x. Its first cell, `first`, is the first of a
 * brick. Returns whether to go on.
 */
bool tribox_bricks_hand_on(const uint64_t *bits, const uint32_t first[3], const uint32_t size[3], tribox_hand *hand);

#endif
