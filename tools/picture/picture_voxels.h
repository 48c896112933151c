/* picture_voxels.h - a shaded picture of voxels, row by row. */
#ifndef PICTURE_VOXELS_H
#define PICTURE_VOXELS_H

#include "console/progress.h"
#include "write/voxels.h"

/* The axis of the grid that is up in the picture, or its opposite. */
typedef enum picture_up { PICTURE_UP_X, PICTURE_UP_Y, PICTURE_UP_Z, PICTURE_DOWN_X, PICTURE_DOWN_Y, PICTURE_DOWN_Z } picture_up;

enum { PICTURE_WIDTH = 1280, PICTURE_HEIGHT = 960 };

/* The bytes that drawing takes beside the cells. */
uint64_t picture_memory(const tribox_grid *grid);

/*
 * Draws into pixels: PICTURE_HEIGHT rows of PICTURE_WIDTH times red, green, blue. Returns false where memory does not suffice.
 * The picture is the same for every number of threads.
 */
bool picture_draw(const voxels *v, picture_up up, unsigned threads, unsigned char *pixels, progress *bar);

#endif
