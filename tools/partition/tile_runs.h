/* tile_runs.h - the triangles of each block sorted by tile: runs, in memory as long as there is some, then in nameless files. */
#ifndef TILE_RUNS_H
#define TILE_RUNS_H

#include "console/processors.h"
#include "mesh_tally.h"
#include "tile_run.h"

typedef struct tile_runs {
    const tribox_grid *grid;
    uint32_t tile; /* cells along a side */
    size_t tiles;  /* of the grid */
    bool has_numbers;
    uint64_t memory; /* bytes that runs, and what it takes to make and to write them, may take */
    tile_run *runs;
    size_t count;
    uint64_t *counts; /* triangles of each tile */
    uint64_t *work;   /* of each tile, without what it costs by itself */
    run_file *files;  /* one for each thread */
    uint64_t spilled; /* bytes */
} tile_runs;

/*
 * Room for so many runs; has_numbers: of triangles, as partitions say. Returns an exit_code; tile_runs_free may follow in any case.
 */
int tile_runs_start(tile_runs *r, const tribox_grid *grid, uint32_t tile, bool has_numbers, size_t count, uint64_t memory);
void tile_runs_free(tile_runs *r);

/* The triangles of a block so that as many threads may each have one, and their runs: at least a few. */
size_t tile_runs_block(const pieces *all, uint64_t memory, unsigned threads);

/*
 * Reads all blocks, one run each, by so many threads; files that it takes are made in the folder. found: of the mesh.
 * Returns an exit_code.
 */
int tile_runs_sort(tile_runs *r, const pieces *all, unsigned threads, bool is_quiet, folder_out *out, tally *found);

/* A partition is a run as it lies there; before: the triangles of those before it. */
void tile_runs_take(tile_runs *r, size_t number, const partition *p, uint64_t before);

#endif
