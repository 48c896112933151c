/* fill_crossings.h - triangles and the rays along x through the middles of rows of cells: where they cross. */
#ifndef TRIBOX_FILL_CROSSINGS_H
#define TRIBOX_FILL_CROSSINGS_H

#include "fill.h"
#include "planes.h"

/* A grid of floats or of doubles, and the rows that crossings are written to. */
typedef struct tribox_crossings {
    const tribox_grid *grid; /* of floats, or NULL */
    tribox_planes planes;    /* of doubles */
    const uint32_t *size;
    tribox_rows rows;
    uint64_t *solid;  /* in the cell that a ray enters when it has crossed, the bit is turned; */
    uint64_t *beyond; /* past the last cell, the bit of the row */
} tribox_crossings;

/* Turns a bit for each crossing of a triangle u[j][a], axis a of vertex j. Nothing of one that is not finite. */
void tribox_crossings_add(const tribox_crossings *c, double u[3][3]);

#endif
