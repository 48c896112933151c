/*
 * layers.c - threads share the triangles of a grid with few words, and the layers of others.
 *
 * The layers are divided into slabs whose estimated work is about equal, by a histogram of the triangles over the layers. A thread
 * takes one slab after another and voxelizes it as a window of whole layers. A slab owns its words, so that the bits are the same
 * for every number of threads. In a grid of few words each thread has words of its own.
 */
#define _POSIX_C_SOURCE 200809L
#include "voxel_task.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/system.h"
#include "tribox_threads.h"

/* ----------------------------------------------------------------------------------------------------------------------- tasks */

voxel_task voxel_task_of_soup(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options)
{
    return (voxel_task){.soup = soup, .count = soup->count, .grid = *grid, .options = options};
}

static tribox_soup part_of_soup(const tribox_soup *soup, size_t start, size_t count)
{
    tribox_soup part = {.count = count};
    for (int v = 0; v < 3; v++) {
        part.x[v] = soup->x[v] + start;
        part.y[v] = soup->y[v] + start;
        part.z[v] = soup->z[v] + start;
    }
    return part;
}

static tribox_mesh part_of_mesh(const tribox_mesh *mesh, size_t start, size_t count)
{
    tribox_mesh part = *mesh;
    part.count = count;
    if (mesh->indices) {
        part.indices = (const uint32_t *)mesh->indices + 3 * start;
    } else {
        part.positions = (const double *)mesh->positions + 9 * start;
        part.vertices = 3 * count;
    }
    return part;
}

/* Triangles start .. start + count - 1 into these layers, whose words are `occupied`. */
static tribox_status run_task(const voxel_task *task, size_t start, size_t count, uint32_t first, uint32_t layers,
                              uint64_t *occupied, tribox_report *report)
{
    const tribox_window window = {{0, 0, first}, {task->grid.size[0], task->grid.size[1], layers}};
    if (task->soup) {
        const tribox_soup part = part_of_soup(task->soup, start, count);
        return task->is_thin ? tribox_voxelize_thin(&part, &task->grid, &window, task->options, occupied, report)
                             : tribox_voxelize(&part, &task->grid, &window, task->options, occupied, report);
    }
    const tribox_mesh part = part_of_mesh(task->mesh, start, count);
    return task->is_thin ? tribox_mesh_voxelize_thin(&part, &task->grid, &window, task->options, occupied, report)
                         : tribox_mesh_voxelize(&part, &task->grid, &window, task->options, occupied, report);
}

tribox_status voxel_task_lists(const voxel_task *task, size_t first, size_t count, const tribox_tiles *tiles,
                               const tribox_options *options, size_t *places, uint32_t *list)
{
    return task->soup ? tribox_tile_lists_part(task->soup, first, count, &task->grid, tiles, options, places, list)
                      : tribox_mesh_tile_lists_part(task->mesh, first, count, &task->grid, tiles, options, places, list);
}

void voxel_task_triangle(const voxel_task *task, size_t t, double u[3][3])
{
    const double *const positions = task->soup ? NULL : task->mesh->positions;
    const uint32_t *const indices = task->soup ? NULL : task->mesh->indices;
    for (size_t v = 0; v < 3; v++) {
        const size_t vertex = indices ? indices[3 * t + v] : 3 * t + v;
        u[0][v] = positions ? positions[3 * vertex] : (double)task->soup->x[v][t];
        u[1][v] = positions ? positions[3 * vertex + 1] : (double)task->soup->y[v][t];
        u[2][v] = positions ? positions[3 * vertex + 2] : (double)task->soup->z[v][t];
    }
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* ---------------------------------------------------------------------------------------------------------------- what it takes */

/* Some triangles one after the other. */
enum { LAYERS_BLOCK = 128 };
typedef struct layers_block {
    double lo, hi;      /* no triangle reaches beyond these along z; one with a NaN, which overlaps nothing, may */
    double nanoseconds; /* roughly */
} layers_block;

/* Nanoseconds, roughly: only their ratio matters to the balance, their size to the number of threads. */
static const double triangle_cost = 3, row_cost = 3.5;

/* Twice the length from the least to the greatest of three numbers. */
static double twice_extent(const double u[3]) { return fabs(u[0] - u[1]) + fabs(u[1] - u[2]) + fabs(u[2] - u[0]); }

/* Of one of these triangles, by every `step`-th of them. */
static double cost_of(const voxel_task *task, size_t start, size_t count, size_t step)
{
    const double across = 0.5 / task->grid.cell[1], up = 0.5 / task->grid.cell[2];
    double sum = 0;
    size_t seen = 0;
    for (size_t t = 0; t < count; t += step, seen++) {
        double u[3][3];
        voxel_task_triangle(task, start + t, u);
        sum += triangle_cost + row_cost * across * twice_extent(u[1]) * (1 + up * twice_extent(u[2]));
    }
    return seen && isfinite(sum) ? sum / (double)seen : triangle_cost;
}

/* A NaN is passed over. Loops over a fixed number of lanes are taken at once. */
static void widen_block(const float *z, size_t count, layers_block *block)
{
    enum { LANES = 16 };
    float lo[LANES], hi[LANES];
    size_t t = 0;
    for (int l = 0; l < LANES; l++) {
        lo[l] = INFINITY;
        hi[l] = -INFINITY;
    }
    for (; t + LANES <= count; t += LANES)
        for (size_t l = 0; l < LANES; l++) {
            lo[l] = z[t + l] < lo[l] ? z[t + l] : lo[l];
            hi[l] = z[t + l] > hi[l] ? z[t + l] : hi[l];
        }
    for (; t < count; t++) {
        lo[0] = z[t] < lo[0] ? z[t] : lo[0];
        hi[0] = z[t] > hi[0] ? z[t] : hi[0];
    }
    for (int l = 0; l < LANES; l++) {
        block->lo = fmin(block->lo, (double)lo[l]);
        block->hi = fmax(block->hi, (double)hi[l]);
    }
}

static layers_block look_at_block(const voxel_task *task, size_t start, size_t count)
{
    enum { STEP = 16 };
    layers_block block = {INFINITY, -INFINITY, (double)count * cost_of(task, start, count, STEP)};
    for (int v = 0; task->soup && v < 3; v++)
        widen_block(task->soup->z[v] + start, count, &block);
    for (size_t t = 0; !task->soup && t < count; t++) {
        double u[3][3];
        voxel_task_triangle(task, start + t, u);
        for (int v = 0; v < 3; v++) {
            block.lo = u[2][v] < block.lo ? u[2][v] : block.lo;
            block.hi = u[2][v] > block.hi ? u[2][v] : block.hi;
        }
    }
    return block;
}

/* Without the box axes every cell of every layer is tested against every triangle. */
static bool is_everywhere(const tribox_options *options) { return options && options->axes && !(options->axes & TRIBOX_AXES_BOX); }

static double sample_work(const voxel_task *task)
{
    enum { BLOCKS = 16, FEW = 16 };
    double sum = 0;
    if (is_everywhere(task->options))
        return (double)task->count * task->grid.size[1] * task->grid.size[2];
    for (size_t b = 0; b < BLOCKS; b++) {
        const size_t start = task->count / BLOCKS * b;
        sum += cost_of(task, start, least(task->count - start, FEW), 1);
    }
    return sum / BLOCKS * (double)task->count;
}

/* Equal parts of the layers: one layer each, or several. */
enum { BINS_MAX = 4096 };

static int bin_of(double place, uint32_t layers, int bins)
{
    const double bin = place * bins / layers;
    return !(bin > 0) ? 0 : bin < bins ? (int)bin : bins - 1;
}

/* Adds the work of a block to the rise of the work from bin to bin: it is spread over the block's layers. */
static void add_block(const tribox_grid *grid, const layers_block *block, int bins, double *rise)
{
    const double lo = (block->lo - grid->origin[2]) / grid->cell[2], hi = (block->hi - grid->origin[2]) / grid->cell[2];
    if (!(hi >= 0 && lo <= grid->size[2]))
        return;
    const int from = bin_of(lo, grid->size[2], bins), to = bin_of(hi, grid->size[2], bins);
    const double in_bin = block->nanoseconds / (to - from + 1);
    rise[from] += in_bin;
    rise[to + 1] -= in_bin;
}

/* ------------------------------------------------------------------------------------------------------------------- triangles */

/* Up to so many words of one's own are put together faster than triangles are looked at twice: a strip of them at a time. */
enum { OWN_WORDS = 1 << 18, STRIP = 1 << 12 };

/* Triangles in a step: enough for a call, and steps enough for threads to end together, or for progress to be seen. */
enum { STEP_LEAST = 512, STEP_MOST = 1 << 15, STEPS_EACH = 8, WINDOW = 1 << 17 };

/* Slabs for each thread. */
enum { EACH = 2, SLABS_MAX = EACH * THREADS_MAX };

typedef struct own_words {
    uint64_t *words;
    tribox_report found;
} own_words;

typedef struct layers_job {
    const voxel_task *task;
    uint64_t *occupied;
    size_t words, layer_words; /* of all layers, and of one */
    unsigned threads;
    progress *bar;      /* NULL for none */
    double all;         /* what is done in the end */
    atomic_size_t done; /* of this */

    size_t step; /* triangles that are taken at once */
    own_words own[THREADS_MAX];
    unsigned owners; /* the first has the words of the grid */
    size_t added[OWN_WORDS / STRIP];

    size_t blocks, slabs;
    layers_block *block;
    bool can_skip;                  /* blocks that do not reach a slab */
    uint32_t border[SLABS_MAX + 1]; /* slab s: the layers border[s] .. border[s + 1] - 1 */
    tribox_report found[SLABS_MAX];
} layers_job;

static void tell(layers_job *job, size_t more)
{
    const size_t done = atomic_fetch_add(&job->done, more) + more;
    if (job->bar)
        progress_tell(job->bar, (double)done / job->all);
}

static void add_report(tribox_report *to, tribox_report found)
{
    to->overlapping += found.overlapping;
    to->undecided += found.undecided;
}

static bool take_words(void *data, void *place)
{
    layers_job *const job = data;
    own_words *const own = *(own_words **)place = &job->own[job->owners];
    own->words = job->owners ? pages_take(job->words * sizeof *own->words) : job->occupied;
    job->owners += own->words != NULL;
    return own->words;
}

static int set_cells(void *data, void *place, size_t n)
{
    layers_job *const job = data;
    own_words *const own = *(own_words **)place;
    const size_t start = n * job->step, count = least(job->step, job->task->count - start);
    tribox_report found = {0, 0};
    const tribox_status status = run_task(job->task, start, count, 0, job->task->grid.size[2], own->words, &found);
    add_report(&own->found, found);
    tell(job, count);
    return (int)status;
}

/* Puts a strip of the words together, and counts what the others add to the first. */
static int put_together(void *data, void *place, size_t n)
{
    layers_job *const job = data;
    const size_t from = n * STRIP, count = least(STRIP, job->words - from);
    uint64_t *const to = job->occupied + from;
    const size_t before = tribox_mask_indices(to, 64 * count, NULL);
    (void)place;
    for (unsigned t = 1; t < job->owners; t++)
        for (size_t i = 0; i < count; i++)
            to[i] |= job->own[t].words[from + i];
    job->added[n] = tribox_mask_indices(to, 64 * count, NULL) - before;
    return 0;
}

/* Each thread sets cells of its own, which are put together at the end; a single one sets those of the grid. */
static int share_triangles(layers_job *job, tribox_report *report)
{
    const size_t count = job->task->count, step = count / (STEPS_EACH * job->threads);
    job->all = (double)count;
    job->step = job->threads == 1   ? (job->bar && job->bar->is_wanted ? WINDOW : count + !count)
                : step < STEP_LEAST ? STEP_LEAST
                                    : least(step, STEP_MOST);
    const crew_work cells = {.threads = job->threads,
                             .count = (count + job->step - 1) / job->step,
                             .place_bytes = sizeof(own_words *),
                             .begin = take_words,
                             .step = set_cells};
    int status = crew_do(&cells, job);
    const size_t strips = job->owners > 1 ? (job->words + STRIP - 1) / STRIP : 0;
    if (!status)
        status = crew_do(&(crew_work){.threads = job->threads, .count = strips, .step = put_together}, job);
    report->overlapping = job->own[0].found.overlapping;
    for (size_t n = 0; n < strips; n++)
        report->overlapping += job->added[n];
    for (unsigned t = 0; t < job->owners; t++)
        report->undecided += job->own[t].found.undecided;
    for (unsigned t = 1; t < job->owners; t++)
        pages_free(job->own[t].words, job->words * sizeof *job->occupied);
    return status;
}

/* ----------------------------------------------------------------------------------------------------------------------- layers */

/*
 * A slab skips blocks of triangles that do not reach it: neighbours in a mesh lie side by side, so that few blocks are in two
 * slabs. Runs of blocks go to the library WINDOW triangles at a time, so that progress is reported meanwhile; a gap of GAP blocks
 * between two of them costs no more than a call. Bounds are found LOOK blocks at a time.
 */
enum { GAP = 4, LOOK = 64 };

static size_t block_triangles(const layers_job *job, size_t from, size_t to)
{
    return least(to * LAYERS_BLOCK, job->task->count) - from * LAYERS_BLOCK;
}

static int look_at_blocks(void *data, void *place, size_t n)
{
    const layers_job *const job = data;
    (void)place;
    for (size_t b = n * LOOK; b < least((n + 1) * LOOK, job->blocks); b++)
        job->block[b] = look_at_block(job->task, b * LAYERS_BLOCK, block_triangles(job, b, b + 1));
    return 0;
}

/* Cuts the layers into slabs of about equal work, by the blocks of all triangles. */
static void cut_layers(layers_job *job)
{
    const tribox_grid *const grid = &job->task->grid;
    const uint32_t layers = grid->size[2];
    const int bins = layers < BINS_MAX ? (int)layers : BINS_MAX;
    double up_to[BINS_MAX + 1] = {0}, in_bin = 0, sum = 0;
    for (size_t b = 0; b < job->blocks; b++)
        add_block(grid, &job->block[b], bins, up_to);
    for (int b = 0; b < bins; b++) {
        in_bin += up_to[b];
        sum += (in_bin > 0 ? in_bin : 0) + 1; /* a little for each, so that slabs without triangles have layers */
        up_to[b] = sum;
    }
    for (size_t s = 0, b = 0; s <= job->slabs; s++) {
        while (b < (size_t)bins && up_to[b] < sum * (double)s / (double)job->slabs)
            b++;
        job->border[s] = (uint32_t)((uint64_t)layers * b / (uint64_t)bins);
    }
    job->border[0] = 0;
    job->border[job->slabs] = layers;
}

/* The lowest plane of a slab and the highest. */
typedef struct slab_planes {
    double lo, hi;
} slab_planes;

static bool reaches(const layers_job *job, size_t block, slab_planes slab)
{
    return !job->can_skip || (job->block[block].lo <= slab.hi && job->block[block].hi >= slab.lo);
}

/* Where the run ends that begins at this block: after blocks that reach the slab, and short gaps between them. */
static size_t run_end(const layers_job *job, size_t from, slab_planes slab)
{
    size_t end = from + 1;
    for (size_t b = end; b < job->blocks && b - end <= GAP && (b - from) * LAYERS_BLOCK < WINDOW; b++)
        if (reaches(job, b, slab))
            end = b + 1;
    return end;
}

static int run_slab(void *data, void *place, size_t n)
{
    layers_job *const job = data;
    const tribox_grid *const grid = &job->task->grid;
    const uint32_t from = job->border[n], to = job->border[n + 1];
    const slab_planes planes = {tribox_grid_cell(grid, 0, 0, from).lo[2], tribox_grid_cell(grid, 0, 0, to - 1).hi[2]};
    tribox_status status = TRIBOX_OK;
    size_t skipped = 0;
    (void)place;
    for (size_t b = 0, end; from < to && b < job->blocks && !status; b = end) {
        tribox_report found = {0, 0};
        const bool is_in = reaches(job, b, planes);
        end = is_in ? run_end(job, b, planes) : b + 1;
        skipped += end - b;
        if (!is_in)
            continue;
        status = run_task(job->task, b * LAYERS_BLOCK, block_triangles(job, b, end), from, to - from,
                          job->occupied + from * job->layer_words, &found);
        add_report(&job->found[n], found);
        tell(job, skipped);
        skipped = 0;
    }
    return (int)status;
}

/* Only for the true answer do bounds alone say that triangles miss a slab, and only where boxes are asked. */
static bool do_bounds_tell(const tribox_options *options)
{
    return !options || (options->accuracy == TRIBOX_EXACT && (!options->axes || options->axes & TRIBOX_AXES_BOX));
}

/* The threads take slabs in turn, which own their words. */
static int share_layers(layers_job *job, tribox_report *report)
{
    job->can_skip = do_bounds_tell(job->task->options);
    job->slabs = EACH * job->threads;
    job->all = (double)job->blocks * (double)job->slabs;
    crew_do(&(crew_work){.threads = job->threads, .count = (job->blocks + LOOK - 1) / LOOK, .step = look_at_blocks}, job);
    cut_layers(job);
    const int status = crew_do(&(crew_work){.threads = job->threads, .count = job->slabs, .step = run_slab}, job);
    for (size_t s = 0; s < job->slabs; s++)
        add_report(report, job->found[s]);
    return status;
}

/* A thread more has to have a share of its own, in nanoseconds, that is worth starting it. */
static unsigned threads_for(const voxel_task *task, unsigned asked)
{
    static const double least_share = 1e5;
    const unsigned most = asked < THREADS_MAX ? asked : THREADS_MAX;
    if (most < 2)
        return 1;
    const double worth = sample_work(task) / least_share;
    return worth < 1 ? 1 : worth < most ? (unsigned)worth : most;
}

tribox_status voxelize_in_threads(const voxel_task *task, unsigned threads, uint64_t *occupied, tribox_report *report,
                                  progress *bar)
{
    tribox_report found = {0, 0};
    layers_job job = {.task = task, .occupied = occupied, .threads = threads_for(task, threads), .bar = bar};
    job.layer_words = tribox_mask_words(task->grid.size[0]) * task->grid.size[1];
    job.words = job.layer_words * task->grid.size[2];
    job.blocks = (task->count + LAYERS_BLOCK - 1) / LAYERS_BLOCK;
    job.block = job.threads > 1 && job.words > OWN_WORDS ? malloc(job.blocks * sizeof *job.block) : NULL;
    if (!job.block && job.words > OWN_WORDS)
        job.threads = 1;
    const int status = job.block ? share_layers(&job, &found) : share_triangles(&job, &found);
    free(job.block);
    if (!status && report)
        *report = found;
    return (tribox_status)status;
}
