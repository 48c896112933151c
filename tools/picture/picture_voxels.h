/* picture_voxels.h - a shaded picture of voxels: one view, one light, and a shadow on the ground. */
#ifndef PICTURE_VOXELS_H
#define PICTURE_VOXELS_H

#include "console/progress.h"
#include "write/voxels.h"

/* The axis of the grid that is up in the picture, or its opposite. */
typedef enum picture_up { PICTURE_UP_X, PICTURE_UP_Y, PICTURE_UP_Z, PICTURE_DOWN_X, PICTURE_DOWN_Y, PICTURE_DOWN_Z } picture_up;

typedef struct picture_look {
    picture_up up;
    uint32_t size[2]; /* pixels: width and height */
} picture_look;

/* Memory for drawing besides the cells, in bytes. */
uint64_t picture_memory(const picture_look *look);

/*
 * Draws rows of red, green, blue bytes. Returns false where memory does not suffice. The picture is the same for every number of
 * threads.
 */
bool picture_draw(const voxels *v, const picture_look *look, unsigned threads, unsigned char *pixels, progress *bar);

#endif
