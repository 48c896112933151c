/* layers_job.c - calls the library, and adds up what it says. */
#define _POSIX_C_SOURCE 200809L
#include "layers_job.h"

bool layers_job_goes_on(layers_job *job)
{
    pthread_mutex_lock(&job->lock);
    const bool is_ok = !job->status;
    pthread_mutex_unlock(&job->lock);
    return is_ok;
}

void layers_job_stop(layers_job *job, tribox_status status)
{
    pthread_mutex_lock(&job->lock);
    job->status = status;
    pthread_mutex_unlock(&job->lock);
}

tribox_report layers_job_run(layers_job *job, size_t start, size_t count, uint32_t first, uint32_t layers, uint64_t *words)
{
    tribox_report found = {0, 0};
    if (!layers_job_goes_on(job))
        return found;
    const tribox_status status = voxel_task_run(job->task, start, count, first, layers, words, &found);
    if (status)
        layers_job_stop(job, status);
    return found;
}

void layers_job_tell(layers_job *job, double share, tribox_report found)
{
    pthread_mutex_lock(&job->lock);
    job->report.overlapping += found.overlapping;
    job->report.undecided += found.undecided;
    job->done += share;
    if (share > 0 && !job->status && job->progress)
        job->progress(job->data, job->done < 1 ? job->done : 1);
    pthread_mutex_unlock(&job->lock);
}
