/* tile_lists.h - which triangles are in which tile: counted, or listed. */
#ifndef TRIBOX_TILE_LISTS_H
#define TRIBOX_TILE_LISTS_H

#include "plan.h"
#include "grid/planes.h"
#include "tiles.h"

/* Tiles base[a] .. base[a] + tiles[a] - 1 of each axis. */
typedef struct tribox_tile_box {
    int64_t base[3], tiles[3];
} tribox_tile_box;

/* The rest of a row, the rest of a layer, layers, rows, and the beginning of a row. */
enum { TRIBOX_SHARE_PARTS = 5 };

/* One call. */
typedef struct tribox_tiles_call {
    tribox_tiling tiling;
    tribox_plan plan;        /* its accuracy is not FAST */
    const tribox_soup *soup; /* with a sound grid; or NULL, and then: */
    const tribox_grid *grid;
    tribox_mesh mesh; /* its strides set, its vertices there */
    tribox_planes planes;
    size_t *starts;
    uint32_t *list; /* NULL to count */

    tribox_tile_box part[TRIBOX_SHARE_PARTS]; /* boxes that the share is made of */
    int parts;
    uint32_t triangle; /* the one at hand */
    tribox_tile_lattice lattice;
} tribox_tiles_call;

/* Makes the starts, or fills the list that they are of. In the environment of environment.h. */
void tribox_tiles_list(tribox_tiles_call *l);

#endif
