/* tile_window.h - the triangles of some tiles from all runs, one tile after the other. */
#ifndef TILE_WINDOW_H
#define TILE_WINDOW_H

#include "tile_runs.h"

typedef struct tile_window {
    const tile_runs *runs;
    partition_tile *records; /* of the partition that comes to be: their checksums are set */
    size_t triangle_bytes;   /* there */
    size_t room;             /* triangles that `bytes` holds, an even number */
    unsigned char *bytes;
    unsigned char *read;              /* as large, for those of a run in a file */
    uint32_t *numbers, *numbers_read; /* the same of numbers; NULL without */
    uint64_t *at;                     /* where the next triangle of each record goes */
} tile_window;

/* Writes triangles, and numbers if there are some, to their place: that of triangle `first`. False where that fails. */
typedef bool tile_window_sink(void *data, uint64_t first, size_t count, const tile_window *w);

/*
 * Writes the triangles of records from .. to - 1, which end at place `end` of the file, and sets their checksums. They fit into the
 * room unless it is one record. Returns false where the sink does; with *damaged where those of a run are not what they were, else
 * with errno where they cannot be read.
 */
bool tile_window_write(tile_window *w, size_t from, size_t to, uint64_t end, tile_window_sink *sink, void *data,
                       const tile_run **damaged);

#endif
