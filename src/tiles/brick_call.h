/* brick_call.h - a call for bricks: the share, its lists, and scratch for one tile after another. */
#ifndef TRIBOX_BRICK_CALL_H
#define TRIBOX_BRICK_CALL_H

#include "base/bits.h"
#include "grid/listed.h"
#include "plan.h"
#include "tiles.h"
#include "voxels/voxelizing.h"

/* The ids of the cells of a tile, where they are asked for, and of those of one brick. */
enum { TRIBOX_BRICK_IDS_ROOM = TRIBOX_BRICK_IDS + TRIBOX_LANES_MAX };
typedef struct tribox_brick_ids {
    tribox_ids_sink sink; /* its take is NULL where none are */
    uint32_t *of_tile, *of_brick;
    tribox_window tile;
} tribox_brick_ids;

/* Cells of a row of a brick, with a triangle: the number of the brick in its part, of the row, and a bit for each cell. */
enum { TRIBOX_PIECE_ROW = 8, TRIBOX_PIECE_BRICK = 14, TRIBOX_PART_BRICKS = 1 << (32 - TRIBOX_PIECE_BRICK) };
typedef struct tribox_piece {
    uint32_t key, number;
} tribox_piece;

/* The triangles of each cell, where they are asked for: of one part of a tile after another. */
typedef struct tribox_brick_lists {
    tribox_lists_sink sink; /* its take is NULL where none are */
    size_t room;            /* for pieces */
    tribox_piece *pieces, *ordered;
    uint32_t *of_bricks;     /* where the pieces of each begin */
    uint32_t *starts, *next; /* of a brick: where the list of each cell begins, and where it goes on */
    uint32_t *triangles;     /* of a brick: room for all of the longest list in each cell */
} tribox_brick_lists;

typedef struct tribox_bricks_call {
    tribox_tiling tiling;
    tribox_triangles triangles;
    const tribox_grid *grid;
    tribox_plan plan;
    const size_t *starts;
    const uint32_t *list;
    uint64_t *bits; /* of a tile: zero before each and after */
    tribox_brick_ids ids;
    tribox_brick_lists lists;
    tribox_listed *block;
    tribox_outlet outlet;
    tribox_report counts;
} tribox_bricks_call;

/* A sink of a tile's bricks that hands each on with its ids. Its data is the call. */
int tribox_brick_ids_take(void *call, const uint32_t at[3], const uint64_t bits[8]);

tribox_window tribox_brick_tile_window(const tribox_tiling *t, size_t tile);

/* Those triangles into a voxelization that has begun, and ends it; z receives the least and the greatest of theirs. */
void tribox_bricks_put(tribox_bricks_call *s, tribox_voxels *v, const uint32_t *list, size_t count, tribox_ends *z);

/* The bytes that lists need besides a block, or SIZE_MAX; and what they are used for. */
size_t tribox_brick_lists_bytes_of(uint32_t side, size_t most);
void tribox_brick_lists_use(tribox_brick_lists *l, uint32_t side, size_t most, void *scratch);

/* The bricks of a tile, from those triangles, with lists. TRIBOX_STOPPED if the sink ended the call, or TRIBOX_BAD_GRID. */
tribox_status tribox_brick_lists_of_tile(tribox_bricks_call *s, size_t number, const uint32_t *list, size_t count);

/* Voxelizes a tile of the grid, from those triangles, one at least, and emits its bricks. False if the sink ended the call. */
bool tribox_bricks_of_tile(tribox_bricks_call *s, size_t number, const uint32_t *list, size_t count);

#endif
