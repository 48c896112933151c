/* block_sort.h - sorts the triangles of one block by tile. */
#ifndef BLOCK_SORT_H
#define BLOCK_SORT_H

#include "tile_runs.h"

typedef struct block_sort {
    unsigned position_bytes;
    uint32_t tile; /* cells along a side */
    bool has_numbers;
    void *positions; /* of the block, nine numbers a triangle */
    size_t *starts;  /* of the lists of the tiles that the block may be in */
    uint32_t *list;  /* as long as was needed until now */
    size_t list_room;
    uint32_t *share;  /* of each triangle: in how many tiles it is, then its work in each */
    tile_run run;     /* the last; its room is the caller's */
    size_t run_bytes; /* of its room */
} block_sort;

/* False where there is no memory; block_sort_close may follow in any case. */
bool block_sort_open(block_sort *b, const pieces *all, const tribox_grid *grid, uint32_t tile, bool has_numbers);
void block_sort_close(block_sort *b);

/* Makes a run of a block, whose triangles are in positions and whose bounds are these. MESSAGE_NO_MEMORY where there is none. */
tribox_status block_sort_run(block_sort *b, const tribox_grid *grid, const piece_block *block, const tribox_box *bounds);

#endif
