/*
 * fans.h - which of the faces around a point of the grid belong together.
 *
 * Eight cells meet in a point; bit dx + 2 dy + 4 dz of their `around` is set where the cell on that side of it is. A face between a
 * set cell and a clear one ends in the point. Two faces with an edge in common belong together; where an edge has four, since two
 * set cells touch in it alone, those of the same cell do. What belongs together is a fan: with a vertex for each fan, the surface
 * is a manifold.
 */
#ifndef FANS_H
#define FANS_H

#include <stdint.h>

typedef struct fans {
    uint8_t count[256];
    uint8_t of[256][12];
} fans;

void fans_make(fans *f);

/* The fan, 0 to 3, of the face across `axis` of the cell at `side`, a bit's number in `around`. The face is there. */
static inline unsigned fans_of(const fans *f, unsigned around, int axis, unsigned side)
{
    const unsigned low = side & ((1U << axis) - 1), high = side >> (axis + 1);
    return f->of[around][4 * (unsigned)axis + (low | high << axis)];
}

#endif
