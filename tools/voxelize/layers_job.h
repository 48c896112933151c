/* layers_job.h - one voxelization of layers by several threads: what they all know, and what they have found together. */
#ifndef LAYERS_JOB_H
#define LAYERS_JOB_H

#include <pthread.h>
#include <stdbool.h>

#include "layers.h"

typedef struct layers_job {
    const voxel_task *task;
    uint64_t *occupied;        /* where layers are taken apart: a slab of each thread's own */
    const layers_taker *taker; /* NULL: they stay */
    uint32_t first, layers;
    size_t layer_words; /* of one layer */
    unsigned threads;
    void (*progress)(void *data, double done);
    void *data;
    pthread_mutex_t lock; /* of what follows, and of progress */
    double done;
    tribox_report report;
    tribox_status status; /* one that is not OK, if there was one */
} layers_job;

/* Triangles start .. start + count - 1 into layers of the grid, the words of which these are; nothing after a failure. */
tribox_report layers_job_run(layers_job *job, size_t start, size_t count, uint32_t first, uint32_t layers, uint64_t *words);

/* False after a failure. */
bool layers_job_goes_on(layers_job *job);

/* Nothing is done any more, and this is what is returned. */
void layers_job_stop(layers_job *job, tribox_status status);

/* Adds a share of the work that has been done, and what it found. */
void layers_job_tell(layers_job *job, double share, tribox_report found);

/* The threads share the triangles: each sets cells of its own, which are put together at the end. For grids of few words. */
void layers_by_triangles(layers_job *job);

/* The threads share the layers: each takes slabs of them in turn, and looks only at blocks of triangles that reach there. */
void layers_by_slabs(layers_job *job);

/* Whether bounds alone tell that triangles miss a slab. */
bool layers_bounds_tell(const tribox_options *options);

/* How many layers go to the taker at once. */
uint32_t layers_apart_step(const layers_job *job);

#endif
