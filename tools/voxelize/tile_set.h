/* tile_set.h - the triangles of each tile of a grid, lists over a mesh in memory or a partition on disk; and what they cost. */
#ifndef TILE_SET_H
#define TILE_SET_H

#include <stdbool.h>

#include "console/progress.h"
#include "console/system.h"
#include "partition/partition.h"
#include "voxel_task.h"

typedef struct tile_set {
    voxel_task task; /* the grid and the options; of a partition no triangles */
    uint32_t tile;   /* cells along a side */
    size_t tiles;    /* of the grid, with and without triangles */
    tribox_options listing;

    const partition_tile *records; /* a record for each tile that has triangles, by rising number */
    size_t count;
    uint64_t places; /* triangles of all tiles together */

    const partition *from; /* NULL: lists */
    size_t *starts;        /* as of tribox_tile_lists for all tiles */
    uint32_t *list;
    partition_tile *own_records;
} tile_set;

/* Cells along a side of a tile, few enough for the caches, or so many that tiles can be numbered. 0 after a line: too many. */
uint32_t tile_set_side(const uint32_t size[3], bool has_ids);

/* Sorts the triangles of a task. has_work: whether the records need their work. Returns an exit_code; on success free it. */
int tile_set_of_task(const voxel_task *task, bool has_work, unsigned threads, tile_set *set);

/* The triangles of a partition, into its grid with these options; both stay as long as the set. */
tile_set tile_set_of_partition(const partition *from, const voxel_task *task);

void tile_set_free(tile_set *set);

/* The records from .. to - 1 of shard 1 .. shards: runs of tiles of about equal work. */
void tile_set_shard(const tile_set *set, uint32_t shard, uint32_t shards, size_t *from, size_t *to);

/* The tile with which the tiles of record `from` begin, so that shards leave out none: 0 for the first, all tiles past the last. */
size_t tile_set_border(const tile_set *set, size_t from);

/* How many triangles a record has. */
size_t tile_set_triangles(const tile_set *set, size_t record);

/* Takes a brick as a tribox_sink does. ids: of its set cells, in the order of the bits; NULL where the set has none. */
typedef struct tile_sink {
    int (*take)(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids);
    void *data;
} tile_sink;

/* What a thread needs to voxelize; NULL where there is no memory. */
typedef struct tile_room tile_room;
tile_room *tile_room_new(const tile_set *set, size_t from, size_t to);
void tile_room_free(tile_room *room);

/*
 * tribox_bricks, or tribox_bricks_ids, for the tiles of records from .. to - 1, which are within those that the room is for.
 * TRIBOX_BAD_VERTEX: the triangles of the partition are damaged.
 */
tribox_status tile_set_run(const tile_set *set, size_t from, size_t to, tile_room *room, const tile_sink *sink,
                           tribox_report *report);

typedef struct tile_found {
    tribox_report report;
    uint64_t bricks;
} tile_found;

/*
 * Voxelizes the tiles of records from .. to - 1 and hands their bricks to the sink, in the order of tribox_bricks and one
 * at a time, but from any of the threads. A thread keeps the bricks of a few tiles until it is their turn; one thread keeps none.
 *
 * sink: NULL to count alone.
 * threads: 1 to THREADS_MAX. Where the system starts fewer, or there is memory for fewer, those do all the work.
 *
 * Returns what tile_set_run does, or MESSAGE_NO_MEMORY where there is none even for one.
 */
tribox_status tile_crew_run(const tile_set *set, size_t from, size_t to, unsigned threads, const tile_sink *sink, progress *bar,
                            tile_found *found);

/* Nanoseconds that a tile takes by itself. */
enum { TILE_WORK = 62000 };

/*
 * What a triangle costs in each of `tiles` tiles that it is in, of this side: whole, so that the sum of a tile is the same in
 * whatever order its triangles are met. u: x, y, z of each vertex.
 */
uint64_t tile_work_of(const tribox_grid *grid, uint32_t side, const double u[9], uint32_t tiles);

#endif
