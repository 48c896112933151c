/* rectangles.h - the faces between set and clear cells, merged into rectangles plane by plane. */
#ifndef RECTANGLES_H
#define RECTANGLES_H

#include "colours/rgb.h"
#include "write/voxels.h"

/* On plane `plane` across `axis`. The other two axes, the lower first, are called u and v here. */
typedef struct rectangle {
    int axis;
    uint32_t plane;
    bool is_up;              /* outside is where the axis points */
    uint32_t from[2], to[2]; /* planes across u and v */
    rgb colour;              /* of all its cells, where they have colours */
} rectangle;

static inline int rectangle_u(int axis) { return axis == 0; }
static inline int rectangle_v(int axis) { return axis == 2 ? 1 : 2; }

/* How many words `mask` of the walk has. */
uint64_t rectangles_words(const tribox_grid *grid);

/*
 * Hands over each rectangle; what is outside the grid is clear. Greedy: as long as possible along u, then along v, of cells of one
 * colour where they have colours. Each time in the same order. tell: called with the share that is done; returns whether to stop.
 */
void rectangles_walk(const voxels *v, uint64_t *mask, void (*take)(void *data, const rectangle *r),
                     bool (*tell)(void *data, double done), void *data);

#endif
