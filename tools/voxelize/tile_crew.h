/* tile_crew.h - the bricks of tiles, by several threads, in one order whatever their number. */
#ifndef TILE_CREW_H
#define TILE_CREW_H

#include "console/processors.h"
#include "console/progress.h"
#include "tile_set.h"

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

#endif
