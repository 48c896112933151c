/* layers_triangles.c - threads that share the triangles of a task, each with words of its own. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>

#include "console/crew.h"
#include "console/steps.h"
#include "layers_job.h"
#include "own_words.h"

/* Triangles in a step: enough for a call, and steps enough for threads to end together. */
enum { STEP_LEAST = 512, STEP_MOST = 1 << 15, STEPS_EACH = 8 };

typedef struct sharing {
    layers_job *job;
    size_t step;
    steps triangles, strips;
    own_words words;
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

static void put_together(sharing *s)
{
    for (size_t n; steps_take(&s->strips, &n);)
        layers_job_tell(s->job, 0, (tribox_report){.overlapping = own_words_join(&s->words, n)});
}

/* Whoever has no memory sets no cells. */
static void work_on(void *data, unsigned thread)
{
    sharing *const s = data;
    uint64_t *const words = own_words_of(&s->words, thread);
    if (words)
        set_cells(s, words);
    steps_wait(&s->triangles);
    put_together(s);
}

void layers_by_triangles(layers_job *job)
{
    sharing s = {.job = job, .step = step_for(job), .words = {.count = job->layer_words * job->layers, .all = job->occupied}};
    steps_start(&s.triangles, (job->task->count + s.step - 1) / s.step);
    steps_start(&s.strips, own_words_strips(&s.words));
    crew_run(job->threads, work_on, &s);
    own_words_free(&s.words);
    steps_free(&s.strips);
    steps_free(&s.triangles);
}
