/* tile_sort.h - a mesh sorted by tile on its way to a partition: runs, each of a block of triangles, and tiles from all runs. */
#ifndef TILE_SORT_H
#define TILE_SORT_H

#include "partition.h"
#include "piece.h"
#include "write/file_out.h"

typedef struct tile_runs tile_runs;

/* What a mesh is like. */
typedef struct tally {
    uint64_t triangles;  /* as far as they were looked at */
    triangles_seen seen; /* of these */
    mesh_sums sums;
    bool fits_float; /* no number is lost as a float */
} tally;

/* Room for so many runs. has_numbers: of triangles. memory: bytes to take at most, for runs and work. NULL after a line. */
tile_runs *tile_runs_make(const tribox_grid *grid, uint32_t tile, bool has_numbers, size_t count, uint64_t memory);

/* Each piece is a run as it lies there. */
tile_runs *tile_runs_of_partition(const partition *p, uint64_t memory);
void tile_runs_free(tile_runs *r);

/* The triangles of a block so that as many threads may each have one, and their runs: at least a few. */
size_t tile_sort_block(const pieces *all, uint64_t memory, unsigned threads);

/* Reads all blocks by so many threads, to know what the mesh is like but for its sums. Returns an exit_code. */
int tile_sort_look(const pieces *all, unsigned threads, tally *found);

/* The same with sums, and makes a run of each block; files that it takes are made in the folder. */
int tile_sort(tile_runs *r, const pieces *all, unsigned threads, folder_out *out, tally *found);

/*
 * Writes the files by so many threads; the folder is still to be kept. header: all but records, places and checksum, which are
 * found here. spilled: bytes of runs that memory did not hold. Returns an exit_code.
 */
int tile_write(folder_out *out, const tile_runs *runs, unsigned threads, partition_header *header, uint64_t *spilled);

#endif
