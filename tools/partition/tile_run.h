/* tile_run.h - triangles sorted by tile, and nameless files for such runs. */
#ifndef TILE_RUN_H
#define TILE_RUN_H

#include <pthread.h>

#include "files/file_map.h"
#include "partition.h"
#include "write/folder_out.h"

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
    struct run_file *file; /* else the file, and where in its streams */
    uint64_t tiles_at, triangles_at, numbers_at;
} tile_run;

/* Of one thread. The tiles are apart, as they are looked at over and over: pages of a map among triangles would be dear. */
typedef struct run_file {
    FILE *tiles, *triangles, *numbers;
    uint64_t tiles_written, triangles_written, numbers_written; /* bytes */
    file_map map;                                               /* of the tiles */
    pthread_mutex_t reading;
} run_file;

/* How many triangles of a run are in its tile i. */
uint64_t tile_run_count(const tile_run *run, size_t i);

bool run_file_is_open(const run_file *file);

/* Puts a run into the file, which is made in the folder if it is not open yet. False with errno. */
bool run_file_put(run_file *file, const folder_out *out, tile_run *run);

/* Once all are there: its runs may be looked at after run_file_find. False where the tiles cannot be mapped. */
bool run_file_map(run_file *file);
void run_file_find(tile_run *run);

/* Reads triangles of a run that is in a file, and, if not NULL, their numbers. False with errno. */
bool run_file_read(const tile_run *run, uint64_t first, size_t count, void *to, uint32_t *numbers);

void run_file_close(run_file *file);

#endif
