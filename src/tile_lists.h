/* tile_lists.h - which triangles are in which tile: counted, or listed. */
#ifndef TRIBOX_TILE_LISTS_H
#define TRIBOX_TILE_LISTS_H

#include "plan.h"
#include "planes.h"
#include "tiles.h"

/* One call. */
typedef struct tribox_listing {
    tribox_tiling tiling;
    tribox_plan plan;        /* its accuracy is not FAST */
    const tribox_soup *soup; /* with a sound grid; or NULL, and then: */
    const tribox_grid *grid;
    tribox_mesh mesh; /* its strides set, its vertices there */
    tribox_planes planes;
    size_t *starts;
    uint32_t *list; /* NULL to count */

    uint32_t triangle; /* the one at hand */
    tribox_tile_lattice lattice;
} tribox_listing;

/* Makes the starts, or fills the list that they are of. In the environment of environment.h. */
void tribox_tiles_list(tribox_listing *l);

#endif
