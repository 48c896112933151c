/* picture_grid.h - voxels made ready for rays: bits in one piece, no finer than a picture shows, and how far the next ones are. */
#ifndef PICTURE_GRID_H
#define PICTURE_GRID_H

#include "write/voxels.h"

/* Cells of a brick along each axis. */
enum { BRICK = 8 };

typedef struct picture_grid {
    int size[3];
    double cell[3]; /* lengths, of which only the ratios matter */
    size_t row_words;
    const uint64_t *bits;
    uint64_t *copy;      /* what bits points to, or NULL where that belongs to another */
    unsigned char *away; /* of each brick: how many bricks the nearest one with a cell is away along the farthest axis, up to 255 */
    int bricks[3];
    int lo[3], hi[3]; /* the occupied cells: lo <= cell < hi; all 0 where there are none */
} picture_grid;

/* Returns false where memory does not suffice; after true picture_grid_free gives it back. The voxels have to stay. */
bool picture_grid_make(const voxels *v, picture_grid *g);
void picture_grid_free(picture_grid *g);

/* The bytes that it takes, at most. */
uint64_t picture_grid_memory(const tribox_grid *grid);

static inline const uint64_t *picture_grid_row(const picture_grid *g, int j, int k)
{
    return g->bits + ((size_t)k * (size_t)g->size[1] + (size_t)j) * g->row_words;
}

/* A cell within the grid. */
static inline bool picture_grid_is_set(const picture_grid *g, const int cell[3])
{
    return voxels_bit(picture_grid_row(g, cell[1], cell[2]), (uint32_t)cell[0]);
}

#endif
