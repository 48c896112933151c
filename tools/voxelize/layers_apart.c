/* layers_apart.c - whether layers are taken apart, and how many at once. */
#include <math.h>

#include "layers_job.h"
#include "layers_work.h"

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Only for the true answer do bounds alone say that triangles miss a slab, and only where boxes are asked. */
bool layers_bounds_tell(const tribox_options *options)
{
    return !options || (options->accuracy == TRIBOX_EXACT && (!options->axes || options->axes & TRIBOX_AXES_BOX));
}

uint32_t layers_apart_step(const layers_job *job)
{
    enum { BYTES = 1 << 21, SLABS_EACH = 4 }; /* what the second cache holds; slabs enough for threads to end together */
    const size_t cached = BYTES / sizeof(uint64_t) / job->layer_words, shared = job->layers / (SLABS_EACH * job->threads);
    const size_t step = least(cached, shared);
    return step ? (uint32_t)step : 1;
}

/* How many slabs of so many layers a block of triangles reaches, about: the mean of some. */
static double slabs_reached(const voxel_task *task, double step)
{
    enum { BLOCKS = 32 };
    const double slab = step * task->grid.cell[2];
    double sum = 0;
    for (size_t b = 0; b < BLOCKS; b++) {
        const size_t start = task->count / BLOCKS * b, left = task->count - start,
                     count = left < LAYERS_BLOCK ? left : LAYERS_BLOCK;
        const layers_block block = layers_work_block(task, start, count);
        sum += 1 + (block.hi > block.lo ? fmin((block.hi - block.lo) / slab, task->grid.size[2] / step) : 0);
    }
    return sum / BLOCKS;
}

/* All layers at once are looked at by each triangle once, but their words lie in memory, not in caches. */
bool layers_apart_pay(const voxel_task *task)
{
    enum { CACHED = 1 << 21, REACHED_MOST = 8 };
    layers_job job = {.task = task, .layers = task->grid.size[2], .threads = 1};
    job.layer_words = tribox_mask_words(task->grid.size[0]) * task->grid.size[1];
    if (job.layer_words * job.layers <= CACHED / sizeof *job.occupied || !layers_bounds_tell(task->options) || !task->count)
        return false;
    return slabs_reached(task, layers_apart_step(&job)) <= REACHED_MOST;
}
