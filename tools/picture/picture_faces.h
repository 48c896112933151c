/* picture_faces.h - the faces of voxels that space can be seen from: those without an occupied cell on their other side. */
#ifndef PICTURE_FACES_H
#define PICTURE_FACES_H

#include "write/voxels.h"

typedef struct picture_face {
    uint16_t cell[3];
} picture_face;

typedef struct picture_faces {
    uint32_t factor;          /* how many cells along each axis are joined to one */
    float cell[3];            /* lengths, the greatest 1 */
    int lo[3], hi[3];         /* the occupied cells: lo <= cell < hi; all 0 where there are none */
    picture_face *list[3][2]; /* by axis; 0: the cell's lower side, 1: its upper */
    size_t count[3][2];
    picture_face *all; /* what the lists are parts of */
} picture_faces;

/*
 * Joins cells that are finer than a picture shows, or whose faces would take too much memory. Returns false where memory does not
 * suffice; after true picture_faces_free gives it back.
 */
bool picture_faces_make(const voxels *v, picture_faces *f);
void picture_faces_free(picture_faces *f);

/* The bytes that they take, at most. */
uint64_t picture_faces_memory(const tribox_grid *grid);

#endif
