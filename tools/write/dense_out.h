/* dense_out.h - the cells of a grid at their places in a file, by several threads, with holes where none is set. */
#ifndef DENSE_OUT_H
#define DENSE_OUT_H

#include <pthread.h>

#include "console/progress.h"
#include "file_out.h"
#include "volume.h"

typedef struct dense_out {
    const file_out *file;
    const volume_frame *frame;
    const tribox_grid *grid;
    bool has_words;       /* of the frame, and there are no labels */
    uint64_t start, end;  /* of the cells in the file */
    bool has_places;      /* else it takes bytes as they come */
    pthread_mutex_t lock; /* of the file and of what follows */
    uint64_t written;     /* where what takes bytes as they come is */
    int reason;           /* of what failed first */
} dense_out;

/* What a thread gathers bytes in; NULL without memory, which dense_put then reports. */
typedef struct dense_room dense_room;
dense_room *dense_room_new(void);
void dense_room_free(dense_room *room);

/* Writes what stands before the cells. v: what they are about; of its slabs alone whether there are labels. */
void dense_start(dense_out *d, const volume_frame *frame, const file_out *file, const voxels *v);

/*
 * Writes layers, the words of which these are, and of those inside, NULL without labels: several threads may at once, each with a
 * room of its own, each layer once and in any order where the file has places; elsewhere one thread, in order. False, and nothing
 * is written, after a failure.
 */
bool dense_put(dense_out *d, dense_room *room, uint32_t first, uint32_t layers, const uint64_t *words, const uint64_t *inside);

/* Writes what stands after the cells, where nothing failed. Returns an exit_code. */
int dense_end(dense_out *d);

/* Instead of that where there was another failure. */
void dense_drop(dense_out *d);

/* All of that for words that are there. Returns an exit_code. */
int dense_write(const volume_frame *frame, const file_out *file, const voxels *v, unsigned threads, progress *bar);

#endif
