/* layers_slabs.c - threads that share the layers of a task, slab after slab. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/pages.h"
#include "console/steps.h"
#include "layers_job.h"
#include "layers_work.h"

/*
 * A slab skips blocks of triangles that do not reach it: neighbours in a mesh lie side by side, so that few blocks are in two
 * slabs. Runs of blocks go to the library WINDOW triangles at a time, so that progress is reported meanwhile; a gap of GAP blocks
 * between two of them costs no more than a call. Bounds are found a step of blocks at a time.
 */
enum { EACH = 2, SLABS_MAX = EACH * THREADS_MAX, GAP = 4, STEP = 64, WINDOW = 1 << 17 };

typedef struct slabs {
    layers_job *job;
    size_t count;
    uint32_t step;                  /* layers of each slab that is taken apart; else 0, and work is cut into about equal parts: */
    uint32_t border[SLABS_MAX + 1]; /* slab s: the layers border[s] .. border[s + 1] - 1 of the range */
    steps looks, cut, slabs;
    size_t blocks;
    layers_block *block; /* each; NULL without memory: slabs have as many layers each, and no block is skipped */
    bool can_skip;
} slabs;

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

static size_t block_triangles(const slabs *s, size_t from, size_t to)
{
    return least(to * LAYERS_BLOCK, s->job->task->count) - from * LAYERS_BLOCK;
}

static void look_at_blocks(slabs *s)
{
    for (size_t n; steps_take(&s->looks, &n); steps_done(&s->looks))
        for (size_t b = n * STEP; b < least((n + 1) * STEP, s->blocks); b++)
            s->block[b] = layers_work_block(s->job->task, b * LAYERS_BLOCK, block_triangles(s, b, b + 1));
    steps_wait(&s->looks);
}

/* One thread does it, when all blocks have been looked at. */
static void cut_layers(slabs *s)
{
    const layers_job *const job = s->job;
    for (size_t n; steps_take(&s->cut, &n); steps_done(&s->cut))
        layers_work_cut(&job->task->grid, job->first, job->layers, s->block, s->block ? s->blocks : 0, (int)s->count, s->border);
    steps_wait(&s->cut);
}

static uint32_t border_of(const slabs *s, size_t slab)
{
    return s->step ? (uint32_t)least(slab * s->step, s->job->layers) : s->border[slab];
}

/* The lowest plane of a slab and the highest. */
typedef struct slab_planes {
    double lo, hi;
} slab_planes;

static slab_planes planes_of(const slabs *s, uint32_t from, uint32_t to)
{
    const layers_job *const job = s->job;
    const tribox_box low = tribox_grid_cell(&job->task->grid, 0, 0, job->first + from);
    const tribox_box high = tribox_grid_cell(&job->task->grid, 0, 0, job->first + to - 1);
    return (slab_planes){low.lo[2], high.hi[2]};
}

static bool reaches(const slabs *s, size_t block, slab_planes slab)
{
    return !s->can_skip || (s->block[block].lo <= slab.hi && s->block[block].hi >= slab.lo);
}

/* Where the run ends that begins at this block: after blocks that reach the slab, and short gaps between them. */
static size_t run_end(const slabs *s, size_t from, slab_planes slab)
{
    size_t end = from + 1;
    for (size_t b = end; b < s->blocks && b - end <= GAP && (b - from) * LAYERS_BLOCK < WINDOW; b++)
        if (reaches(s, b, slab))
            end = b + 1;
    return end;
}

/* words: of the slab. */
static void run_slab(slabs *s, uint32_t from, uint32_t to, uint64_t *words)
{
    layers_job *const job = s->job;
    const slab_planes planes = from < to ? planes_of(s, from, to) : (slab_planes){0, 0};
    double share = 0;
    for (size_t b = 0, end; from < to && b < s->blocks; b = end) {
        tribox_report found = {0, 0};
        const bool is_in = reaches(s, b, planes);
        end = is_in ? run_end(s, b, planes) : b + 1;
        if (is_in)
            found = layers_job_run(job, b * LAYERS_BLOCK, block_triangles(s, b, end), job->first + from, to - from, words);
        share += (double)(end - b) / (double)s->blocks / (double)s->count;
        if (is_in)
            layers_job_tell(job, share, found);
        share = is_in ? 0 : share;
    }
}

static void run_apart(slabs *s, unsigned thread, size_t slab, uint64_t *words)
{
    layers_job *const job = s->job;
    const uint32_t from = border_of(s, slab), to = border_of(s, slab + 1);
    run_slab(s, from, to, words);
    if (layers_job_goes_on(job) && !job->taker->take(job->taker->data, thread, job->first + from, to - from, words))
        layers_job_stop(job, TRIBOX_STOPPED);
    memset(words, 0, (to - from) * job->layer_words * sizeof *words);
}

/* Who has no memory leaves the slabs to others; the calling thread took its own before any other began. */
static void work_apart(slabs *s, unsigned thread)
{
    const layers_job *const job = s->job;
    const size_t bytes = s->step * job->layer_words * sizeof *job->occupied;
    uint64_t *const words = thread ? pages_take(bytes) : job->occupied;
    if (words && (!thread || job->taker->begin(job->taker->data, thread)))
        for (size_t n; steps_take(&s->slabs, &n);)
            run_apart(s, thread, n, words);
    if (thread)
        pages_free(words, bytes);
}

static void work_on(void *data, unsigned thread)
{
    slabs *const s = data;
    look_at_blocks(s);
    cut_layers(s);
    if (s->step)
        work_apart(s, thread);
    for (size_t n; !s->step && steps_take(&s->slabs, &n);)
        run_slab(s, border_of(s, n), border_of(s, n + 1), s->job->occupied + border_of(s, n) * s->job->layer_words);
}

void layers_by_slabs(layers_job *job)
{
    slabs s = {.job = job, .count = EACH * job->threads, .blocks = (job->task->count + LAYERS_BLOCK - 1) / LAYERS_BLOCK};
    s.block = malloc(s.blocks * sizeof *s.block);
    s.can_skip = s.block && layers_bounds_tell(job->task->options);
    if (job->taker) {
        s.step = layers_apart_step(job);
        s.count = (job->layers + s.step - 1) / s.step;
    }
    steps_start(&s.cut, !s.step);
    steps_start(&s.looks, s.block ? (s.blocks + STEP - 1) / STEP : 0);
    steps_start(&s.slabs, s.count);
    crew_run(job->threads, work_on, &s);
    steps_free(&s.slabs);
    steps_free(&s.cut);
    steps_free(&s.looks);
    free(s.block);
}
