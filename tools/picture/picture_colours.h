/* picture_colours.h - the colours of cells, as light. */
#ifndef PICTURE_COLOURS_H
#define PICTURE_COLOURS_H

#include "colours/rgb.h"
#include "vec.h"
#include "write/voxels.h"

typedef struct picture_colours {
    const voxels *v;
    uint32_t factor; /* how many cells along each axis are one of the picture */
    rgb_curve curve;
} picture_colours;

picture_colours picture_colours_of(const voxels *v, uint32_t factor);

/* The mean of what is set of a cell of the picture; false where nothing is. */
bool picture_colours_at(const picture_colours *c, const int cell[3], vec *colour);

#endif
