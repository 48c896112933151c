/*
 * tile_runs.h - a mesh sorted by tile on its way to a partition. tile_sort.c makes a run of each block of triangles, which stays in
 * memory as long as there is some and then goes into nameless files, tile_run.c; tile_write.c writes each tile from all runs.
 */
#ifndef TILE_RUNS_H
#define TILE_RUNS_H

#include "files/file_map.h"
#include "partition.h"
#include "piece.h"
#include "write/file_out.h"

/* Triangles as they are in a partition: by rising tile, those of a tile in the order of the mesh. */
typedef struct tile_run {
    const partition_tile *tiles; /* whose work is without what a tile costs by itself, and whose checksum is not set */
    size_t count;
    uint64_t places;                /* triangles */
    const unsigned char *triangles; /* NULL in a file */
    const uint32_t *numbers;        /* of these triangles; NULL where there are none, and in a file */
    uint64_t before;                /* what is added to them */
    unsigned position_bytes;
    const partition *from; /* NULL, or a partition whose run this is, with work and checksums as there */
    void *room;            /* NULL, or what tiles and triangles lie in */
    struct run_file *file; /* else the file, and where in it */
    uint64_t tiles_at, triangles_at;
} tile_run;

/* Of one thread. The tiles are apart, as they are looked at over and over: pages of a map among triangles would be dear. */
typedef struct run_file {
    FILE *tiles, *rest; /* rest: triangles of a run, then their numbers; NULL: there is no file yet */
    uint64_t tiles_written, rest_written;
    file_map map; /* of the tiles */
} run_file;

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

/* What a mesh is like. */
typedef struct tally {
    tribox_box bounds;              /* of the triangles that are finite; lo > hi where there are none */
    uint64_t triangles, not_finite; /* as far as they were looked at */
    uint64_t first_not_finite;      /* the number of the first of them */
    mesh_sums sums;
    bool fits_float; /* no number is lost as a float */
} tally;

/* Room for so many runs. has_numbers: of triangles. Returns an exit_code; tile_runs_free may follow in any case. */
int tile_runs_start(tile_runs *r, const tribox_grid *grid, uint32_t tile, bool has_numbers, size_t count, uint64_t memory);
void tile_runs_free(tile_runs *r);

/* The triangles of a block so that as many threads may each have one, and their runs: at least a few. */
size_t tile_runs_block(const pieces *all, uint64_t memory, unsigned threads);

/* A partition is a run as it lies there; before: the triangles of those before it. */
void tile_runs_take(tile_runs *r, size_t number, const partition *p, uint64_t before);

/* Reads all blocks by so many threads, to know what the mesh is like but for its sums. Returns an exit_code. */
int tile_sort_look(const pieces *all, unsigned threads, bool is_quiet, tally *found);

/* The same with sums, and makes a run of each block; files that it takes are made in the folder. */
int tile_sort(tile_runs *r, const pieces *all, unsigned threads, bool is_quiet, folder_out *out, tally *found);

/* In the order of folder_out's files; the last is left out where triangles have no numbers. */
#define PARTITION_NAMES(has_numbers) ((const char *const[FOLDER_FILES]){"index", "triangles", (has_numbers) ? "numbers" : NULL})

/*
 * Writes the files by so many threads; the folder is still to be kept. header: all but records, places and checksum, which are
 * found here. Returns an exit_code.
 */
int tile_write(folder_out *out, const tile_runs *runs, unsigned threads, bool is_quiet, partition_header *header);

/* How many triangles of a run are in its tile i. */
uint64_t tile_run_count(const tile_run *run, size_t i);

/* Puts a run into the file, which is made in the folder if it is not there yet. False with errno. */
bool run_file_put(run_file *file, const folder_out *out, tile_run *run);

/* Once all are there: its runs may be looked at after run_file_find. False where the tiles cannot be mapped. */
bool run_file_map(run_file *file);
void run_file_find(tile_run *run);

/* Reads triangles of a run that is in a file, and, if not NULL, their numbers; several threads may at once. False with errno. */
bool run_file_read(const tile_run *run, uint64_t first, size_t count, void *to, uint32_t *numbers);

void run_file_close(run_file *file);

#endif
