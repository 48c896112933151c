/* layers.c - chooses how threads share a voxelization: not at all, by triangles, or by layers. */
#define _POSIX_C_SOURCE 200809L
#include "layers.h"

#include <stddef.h>

#include "layers_job.h"
#include "layers_work.h"

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
    enum { OWN_BYTES = 1 << 21 }; /* words of one's own up to these are put together faster than triangles are looked at twice */
    job->threads = threads_for(job, threads);
    if (job->threads == 1)
        run_alone(job);
    else if (job->layer_words * job->layers <= OWN_BYTES / sizeof *job->occupied)
        layers_by_triangles(job);
    else
        layers_by_slabs(job);
}

tribox_status voxelize_in_threads(const voxel_task *task, uint32_t first, uint32_t layers, unsigned threads, uint64_t *occupied,
                                  tribox_report *report, void (*progress)(void *data, double done), void *data)
{
    const tribox_status status = check_layers(task, first, layers, occupied);
    if (status)
        return status;
    layers_job job = {.task = task, .occupied = occupied, .first = first, .layers = layers, .progress = progress, .data = data};
    job.layer_words = tribox_mask_words(task->grid.size[0]) * task->grid.size[1];
    pthread_mutex_init(&job.lock, NULL);
    if (layers)
        run(&job, threads);
    pthread_mutex_destroy(&job.lock);
    if (!job.status && report)
        *report = job.report;
    return job.status;
}
