/* layers_slabs.c - threads that share the layers of a task, slab after slab. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/steps.h"
#include "layers_job.h"
#include "layers_work.h"

/*
 * A slab skips blocks of triangles that do not reach it: neighbours in a mesh lie side by side, so that few blocks are in two slabs.
 * Runs of blocks go to the library WINDOW triangles at a time, so that progress is reported meanwhile; a gap of GAP blocks between
 * two of them costs no more than a call. Bounds are found a step of blocks at a time.
 */
enum { EACH = 2, SLABS_MAX = EACH * THREADS_MAX, GAP = 4, STEP = 64, WINDOW = 1 << 17 };

typedef struct slabs {
    layers_job *job;
    int count;
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
        layers_work_cut(&job->task->grid, job->first, job->layers, s->block, s->block ? s->blocks : 0, s->count, s->border);
    steps_wait(&s->cut);
}

/* The lowest plane of a slab and the highest. */
typedef struct slab_planes {
    double lo, hi;
} slab_planes;

static slab_planes planes_of(const slabs *s, int slab)
{
    const layers_job *const job = s->job;
    const tribox_box low = tribox_grid_cell(&job->task->grid, 0, 0, job->first + s->border[slab]);
    const tribox_box high = tribox_grid_cell(&job->task->grid, 0, 0, job->first + s->border[slab + 1] - 1);
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

static void run_slab(slabs *s, int slab)
{
    layers_job *const job = s->job;
    const uint32_t layers = s->border[slab + 1] - s->border[slab];
    const slab_planes planes = layers ? planes_of(s, slab) : (slab_planes){0, 0};
    uint64_t *const words = job->occupied + job->layer_words * s->border[slab];
    double share = 0;
    for (size_t b = 0, end; layers && b < s->blocks; b = end) {
        tribox_report found = {0, 0};
        const bool is_in = reaches(s, b, planes);
        end = is_in ? run_end(s, b, planes) : b + 1;
        if (is_in)
            found = layers_job_run(job, b * LAYERS_BLOCK, block_triangles(s, b, end), job->first + s->border[slab], layers, words);
        share += (double)(end - b) / (double)s->blocks / s->count;
        if (is_in)
            layers_job_tell(job, share, found);
        share = is_in ? 0 : share;
    }
}

static void work_on(void *data, unsigned thread)
{
    slabs *const s = data;
    (void)thread;
    look_at_blocks(s);
    cut_layers(s);
    for (size_t n; steps_take(&s->slabs, &n);)
        run_slab(s, (int)n);
}

/* Only for the true answer do bounds alone say that triangles miss a slab, and only where boxes are asked. */
static bool bounds_tell(const tribox_options *options)
{
    return !options || (options->accuracy == TRIBOX_EXACT && (!options->axes || options->axes & TRIBOX_AXES_BOX));
}

void layers_by_slabs(layers_job *job)
{
    slabs s = {.job = job, .count = EACH * (int)job->threads, .blocks = (job->task->count + LAYERS_BLOCK - 1) / LAYERS_BLOCK};
    s.block = malloc(s.blocks * sizeof *s.block);
    s.can_skip = s.block && bounds_tell(job->task->options);
    steps_start(&s.cut, 1);
    steps_start(&s.looks, s.block ? (s.blocks + STEP - 1) / STEP : 0);
    steps_start(&s.slabs, (size_t)s.count);
    crew_run(job->threads, work_on, &s);
    steps_free(&s.slabs);
    steps_free(&s.cut);
    steps_free(&s.looks);
    free(s.block);
}
