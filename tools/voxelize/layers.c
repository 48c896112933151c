/* layers.c - chooses how threads share a voxelization: not at all, by triangles, or by layers. */
#define _POSIX_C_SOURCE 200809L
#include "layers.h"

#include <stddef.h>

#include "console/pages.h"
#include "layers_job.h"
#include "layers_work.h"
#include "own_words.h"

/* What the library returns for these arguments but the triangles, before any thread starts. */
static tribox_status check_layers(const voxel_task *task, uint32_t first, uint32_t layers, uint64_t *occupied)
{
    const tribox_soup nothing = {.count = 0};
    const tribox_window none = {{0, 0, first}, {task->grid.size[0], task->grid.size[1], 0}};
    const tribox_status status = tribox_voxelize(&nothing, &task->grid, &none, task->options, occupied, NULL);
    return status ? status : layers > task->grid.size[2] - first ? TRIBOX_BAD_ARGUMENT : TRIBOX_OK;
}

/* In pieces, so that progress is reported meanwhile. */
static void run_alone(layers_job *job)
{
    enum { WINDOW = 1 << 17 };
    const size_t all = job->task->count, most = job->progress ? WINDOW : all;
    for (size_t start = 0, count; start < all; start += count) {
        count = all - start < most ? all - start : most;
        const tribox_report found = layers_job_run(job, start, count, job->first, job->layers, job->occupied);
        layers_job_tell(job, (double)count / (double)all, found);
    }
}

/* A thread more has to have a share of its own, in nanoseconds, that is worth starting it. */
static unsigned threads_for(const layers_job *job, unsigned asked)
{
    static const double least = 1e5;
    const unsigned most = asked < THREADS_MAX ? asked : THREADS_MAX;
    if (most < 2)
        return 1;
    const double worth = layers_work_sample(job->task) / least;
    return worth < 1 ? 1 : worth < most ? (unsigned)worth : most;
}

static void run(layers_job *job, unsigned threads)
{
    job->threads = threads_for(job, threads);
    if (job->threads == 1)
        run_alone(job);
    else if (job->layer_words * job->layers <= OWN_WORDS_BYTES / sizeof *job->occupied)
        layers_by_triangles(job);
    else
        layers_by_slabs(job);
}

static layers_job job_of(const voxel_task *task, uint32_t first, uint32_t layers, uint64_t *occupied,
                         void (*progress)(void *data, double done), void *data)
{
    layers_job job = {.task = task, .occupied = occupied, .first = first, .layers = layers, .progress = progress, .data = data};
    job.layer_words = tribox_mask_words(task->grid.size[0]) * task->grid.size[1];
    pthread_mutex_init(&job.lock, NULL);
    return job;
}

static tribox_status end_job(layers_job *job, tribox_report *report)
{
    pthread_mutex_destroy(&job->lock);
    if (!job->status && report)
        *report = job->report;
    return job->status;
}

tribox_status voxelize_in_threads(const voxel_task *task, uint32_t first, uint32_t layers, unsigned threads, uint64_t *occupied,
                                  tribox_report *report, void (*progress)(void *data, double done), void *data)
{
    const tribox_status status = check_layers(task, first, layers, occupied);
    if (status)
        return status;
    layers_job job = job_of(task, first, layers, occupied, progress, data);
    if (layers)
        run(&job, threads);
    return end_job(&job, report);
}

tribox_status voxelize_layers_apart(const voxel_task *task, unsigned threads, const layers_taker *taker, tribox_report *report,
                                    void (*progress)(void *data, double done), void *data)
{
    const uint32_t layers = task->grid.size[2];
    const tribox_status status = check_layers(task, 0, layers, (uint64_t[]){0});
    if (status)
        return status;
    layers_job job = job_of(task, 0, layers, NULL, progress, data);
    job.taker = taker;
    job.threads = threads_for(&job, threads);
    const size_t bytes = layers_apart_step(&job) * job.layer_words * sizeof *job.occupied;
    job.occupied = pages_take(bytes);
    job.status = job.occupied ? TRIBOX_OK : TRIBOX_STOPPED;
    if (job.occupied)
        layers_by_slabs(&job);
    pages_free(job.occupied, bytes);
    return end_job(&job, report);
}
