/* brick_call.h - a call for bricks: the share, its lists, and scratch for one tile after another. */
#ifndef TRIBOX_BRICK_CALL_H
#define TRIBOX_BRICK_CALL_H

#include "grid/listed.h"
#include "plan.h"
#include "tiles.h"

/* The ids of the cells of a tile, where they are asked for, and of those of one brick. */
enum { TRIBOX_BRICK_IDS_ROOM = TRIBOX_BRICK_IDS + TRIBOX_LANES_MAX };
typedef struct tribox_brick_ids {
    tribox_ids_sink sink; /* its take is NULL where none are */
    uint32_t *of_tile, *of_brick;
    tribox_window tile;
} tribox_brick_ids;

typedef struct tribox_bricks_call {
    tribox_tiling tiling;
    tribox_triangles triangles;
    const tribox_grid *grid;
    tribox_plan plan;
    const size_t *starts;
    const uint32_t *list;
    uint64_t *bits; /* of a tile: zero before each and after */
    tribox_brick_ids ids;
    tribox_listed *block;
    tribox_outlet outlet;
    tribox_report counts;
} tribox_bricks_call;

/* A sink of a tile's bricks that hands each on with its ids. Its data is the call. */
int tribox_brick_ids_take(void *call, const uint32_t at[3], const uint64_t bits[8]);

/* Voxelizes a tile of the grid, from those triangles, one at least, and emits its bricks. False if the sink ended the call. */
bool tribox_bricks_of_tile(tribox_bricks_call *s, size_t number, const uint32_t *list, size_t count);

#endif
