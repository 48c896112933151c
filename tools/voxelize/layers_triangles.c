/* layers_triangles.c - threads that share the triangles of a task, each with words of its own. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>

#include "console/crew.h"
#include "console/pages.h"
#include "console/steps.h"
#include "layers_job.h"

/* Triangles in a step: enough for a call, and steps enough for threads to end together. Words in a strip of those put together. */
enum { STEP_LEAST = 512, STEP_MOST = 1 << 15, STEPS_EACH = 8, STRIP = 4096 };

typedef struct sharing {
    layers_job *job;
    size_t step, words;
    steps triangles, strips;
    uint64_t *own[THREADS_MAX]; /* NULL: that thread has set nothing, or sets them where all go */
} sharing;

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static size_t step_for(const layers_job *job)
{
    const size_t step = job->task->count / (STEPS_EACH * job->threads);
    return step < STEP_LEAST ? STEP_LEAST : least(step, STEP_MOST);
}

/* The words are the thread's own, whose cells are counted when they are put together, or those of the job. */
static void set_cells(sharing *s, uint64_t *words)
{
    layers_job *const job = s->job;
    for (size_t n; steps_take(&s->triangles, &n); steps_done(&s->triangles)) {
        const size_t start = n * s->step, count = least(s->step, job->task->count - start);
        tribox_report found = layers_job_run(job, start, count, job->first, job->layers, words);
        if (words != job->occupied)
            found.overlapping = 0;
        layers_job_tell(job, (double)count / (double)job->task->count, found);
    }
}

static size_t put_together(sharing *s, size_t from, size_t count)
{
    uint64_t *const to = s->job->occupied + from;
    const size_t before = tribox_mask_indices(to, 64 * count, NULL);
    for (unsigned t = 1; t < THREADS_MAX; t++)
        for (size_t w = 0; s->own[t] && w < count; w++)
            to[w] |= s->own[t][from + w];
    return tribox_mask_indices(to, 64 * count, NULL) - before;
}

static void put_strips(sharing *s)
{
    for (size_t n; steps_take(&s->strips, &n);) {
        const size_t from = n * STRIP;
        layers_job_tell(s->job, 0, (tribox_report){.overlapping = put_together(s, from, least(STRIP, s->words - from))});
    }
}

/* Whoever has no memory sets no cells. */
static void work_on(void *data, unsigned thread)
{
    sharing *const s = data;
    if (thread)
        s->own[thread] = pages_take(s->words * sizeof **s->own);
    if (!thread || s->own[thread])
        set_cells(s, thread ? s->own[thread] : s->job->occupied);
    steps_wait(&s->triangles);
    put_strips(s);
}

static size_t steps_of(size_t count, size_t each) { return (count + each - 1) / each; }

void layers_by_triangles(layers_job *job)
{
    sharing s = {.job = job, .step = step_for(job), .words = job->layer_words * job->layers};
    steps_start(&s.triangles, steps_of(job->task->count, s.step));
    steps_start(&s.strips, steps_of(s.words, STRIP));
    crew_run(job->threads, work_on, &s);
    for (unsigned t = 1; t < THREADS_MAX; t++)
        pages_free(s.own[t], s.words * sizeof **s.own);
    steps_free(&s.strips);
    steps_free(&s.triangles);
}
