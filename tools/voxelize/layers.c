/* layers.c - threads that take slabs of layers in turn. */
#define _POSIX_C_SOURCE 200809L
#include "layers.h"

#include <pthread.h>
#include <stddef.h>

#include "console/crew.h"
#include "layers_work.h"

/*
 * Every slab looks at all triangles and skips those of others, which is cheap but not free, and large triangles are in many slabs:
 * there are more slabs than threads, EACH_MOST times as many, only where skipping costs no more than a fourteenth of the work.
 * WINDOW triangles at a time, so that progress is reported meanwhile.
 */
enum { EACH_MOST = 3, SLABS_MAX = EACH_MOST * THREADS_MAX, WINDOW = 1 << 17 };
static const double skip_cost = 0.7, skip_share = 0.07; /* nanoseconds, as in layers_work.c */

typedef struct crew {
    const voxel_task *task;
    uint64_t *occupied;
    uint32_t first;
    int slabs;
    uint32_t border[SLABS_MAX + 1]; /* slab s: the layers border[s] .. border[s + 1] - 1 of the range */
    void (*progress)(void *data, double done);
    void *data;
    pthread_mutex_t lock; /* of what follows, and of progress */
    int next;
    double done; /* in slabs */
    tribox_report report;
    tribox_status status;
} crew;

/* A multiple of the threads, so that all end together. */
static int slabs_for(const layers_work *work, size_t triangles, unsigned threads)
{
    const double cheap = skip_share * layers_work_total(work) / (skip_cost * (double)triangles + 1);
    const double each = cheap / threads;
    return (int)threads * (each < 1 ? 1 : each < EACH_MOST ? (int)each : EACH_MOST);
}

static void set_borders(crew *c, const layers_work *work, uint32_t layers)
{
    for (int s = 0; s <= c->slabs; s++)
        c->border[s] = layers_work_share(work, layers, (double)s / c->slabs);
    c->border[0] = 0;
    c->border[c->slabs] = layers;
}

static int take_slab(crew *c)
{
    pthread_mutex_lock(&c->lock);
    const int slab = c->status ? c->slabs : c->next;
    c->next += slab < c->slabs;
    pthread_mutex_unlock(&c->lock);
    return slab;
}

static void account(crew *c, tribox_status status, const tribox_report *report, double share)
{
    pthread_mutex_lock(&c->lock);
    if (status)
        c->status = status;
    c->report.overlapping += report->overlapping;
    c->report.undecided += report->undecided;
    c->done += share;
    if (!status && c->progress)
        c->progress(c->data, c->done < c->slabs ? c->done / c->slabs : 1);
    pthread_mutex_unlock(&c->lock);
}

static void run_slab(crew *c, int slab)
{
    const voxel_task *const task = c->task;
    const uint32_t layers = c->border[slab + 1] - c->border[slab];
    uint64_t *own = c->occupied + tribox_mask_words(task->grid.size[0]) * task->grid.size[1] * c->border[slab];
    for (size_t start = 0; layers && start < task->count; start += WINDOW) {
        const size_t count = task->count - start < WINDOW ? task->count - start : WINDOW;
        tribox_report report = {0, 0};
        const tribox_status status = voxel_task_run(task, start, count, c->first + c->border[slab], layers, own, &report);
        account(c, status, &report, (double)count / (double)task->count);
        if (status)
            return;
    }
}

static void work_on(void *data, unsigned thread)
{
    crew *c = data;
    (void)thread;
    for (int slab; (slab = take_slab(c)) < c->slabs;)
        run_slab(c, slab);
}

static void run_crew(crew *c, unsigned threads)
{
    pthread_mutex_init(&c->lock, NULL);
    crew_run(threads, work_on, c);
    pthread_mutex_destroy(&c->lock);
}

/* What the library returns for these arguments but the triangles, before any thread starts. */
static tribox_status check_layers(const voxel_task *task, uint32_t first, uint32_t layers, uint64_t *occupied)
{
    const tribox_soup nothing = {.count = 0};
    const tribox_window none = {{0, 0, first}, {task->grid.size[0], task->grid.size[1], 0}};
    const tribox_status status = tribox_voxelize(&nothing, &task->grid, &none, task->options, occupied, NULL);
    return status ? status : layers > task->grid.size[2] - first ? TRIBOX_BAD_ARGUMENT : TRIBOX_OK;
}

tribox_status voxelize_in_threads(const voxel_task *task, uint32_t first, uint32_t layers, unsigned threads, uint64_t *occupied,
                                  tribox_report *report, void (*progress)(void *data, double done), void *data)
{
    const tribox_status status = check_layers(task, first, layers, occupied);
    if (status)
        return status;
    threads = !threads ? 1 : threads < THREADS_MAX ? threads : THREADS_MAX;
    crew c = {.task = task, .occupied = occupied, .first = first, .progress = progress, .data = data};
    if (layers) {
        layers_work work;
        layers_work_estimate(task, first, layers, &work);
        c.slabs = threads == 1 && !progress ? 1 : slabs_for(&work, task->count, threads);
        set_borders(&c, &work, layers);
        run_crew(&c, threads);
    }
    if (!c.status && report)
        *report = c.report;
    return c.status;
}
