/* layers_work.c - estimates the work in each layer: what a triangle costs by itself and by the rows of cells about it. */
#include "layers_work.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Nanoseconds, roughly: only their ratio matters to the balance, their size to the number of threads. */
static const float triangle_cost = 3, row_cost = 3.5F;

/* Floats in the order of integers, which compilers compare many at once: numbers as they are, NaN beyond the infinities. */
static int32_t key_of(float x)
{
    int32_t key;
    memcpy(&key, &x, sizeof key);
    return key ^ (key >> 31 & INT32_MAX);
}

static double number_of(int32_t key, double instead_of_nan)
{
    const int32_t bits = key ^ (key >> 31 & INT32_MAX);
    float x;
    memcpy(&x, &bits, sizeof x);
    return isnan(x) ? instead_of_nan : (double)x;
}

static void set_bounds(layers_block *block, const float *const z[3], size_t count)
{
    int32_t lo = INT32_MAX, hi = INT32_MIN;
    for (int v = 0; v < 3; v++) {
        const float *const from = z[v];
        for (size_t t = 0; t < count; t++) {
            const int32_t key = key_of(from[t]);
            lo = key < lo ? key : lo;
            hi = key > hi ? key : hi;
        }
    }
    block->lo = number_of(lo, -INFINITY);
    block->hi = number_of(hi, INFINITY);
}

/* Twice the length from the least to the greatest of three numbers. */
static float twice_extent(float a, float b, float c) { return fabsf(a - b) + fabsf(b - c) + fabsf(c - a); }

/* Loops without a sum from one triangle to the next are taken many at once. */
static double work_of(const voxel_task *task, const float *const y[3], const float *const z[3], size_t count)
{
    const float across = (float)(0.5 / task->grid.cell[1]), up = (float)(0.5 / task->grid.cell[2]);
    const float *const y0 = y[0], *const y1 = y[1], *const y2 = y[2], *const z0 = z[0], *const z1 = z[1], *const z2 = z[2];
    float cost[LAYERS_BLOCK] = {0};
    for (size_t t = 0; t < count; t++) {
        const float rows = across * twice_extent(y0[t], y1[t], y2[t]), layers = up * twice_extent(z0[t], z1[t], z2[t]);
        cost[t] = triangle_cost + row_cost * rows * (1 + layers);
    }
    for (size_t half = LAYERS_BLOCK / 2; half; half /= 2)
        for (size_t t = 0; t < half; t++)
            cost[t] += cost[t + half];
    return cost[0] < INFINITY ? (double)cost[0] : (double)triangle_cost * (double)count;
}

static layers_block block_of(const voxel_task *task, const float *const y[3], const float *const z[3], size_t count)
{
    layers_block block = {.nanoseconds = work_of(task, y, z, count)};
    set_bounds(&block, z, count);
    return block;
}

/* Bounds are those of the doubles; the work takes no more than floats. */
static layers_block block_of_doubles(const voxel_task *task, size_t start, size_t count)
{
    float y[3][LAYERS_BLOCK], z[3][LAYERS_BLOCK];
    double lo = INFINITY, hi = -INFINITY;
    for (size_t t = 0; t < count; t++) {
        double u[3][3];
        voxel_task_triangle(task, start + t, u);
        for (int v = 0; v < 3; v++) {
            lo = u[2][v] < lo ? u[2][v] : lo;
            hi = u[2][v] > hi ? u[2][v] : hi;
            y[v][t] = (float)u[1][v];
            z[v][t] = (float)u[2][v];
        }
    }
    layers_block block =
        block_of(task, (const float *const[3]){y[0], y[1], y[2]}, (const float *const[3]){z[0], z[1], z[2]}, count);
    block.lo = lo;
    block.hi = hi;
    return block;
}

layers_block layers_work_block(const voxel_task *task, size_t start, size_t count)
{
    const tribox_soup *const soup = task->soup;
    if (!soup)
        return block_of_doubles(task, start, count);
    const float *const y[3] = {soup->y[0] + start, soup->y[1] + start, soup->y[2] + start};
    const float *const z[3] = {soup->z[0] + start, soup->z[1] + start, soup->z[2] + start};
    return block_of(task, y, z, count);
}

/* Without the box axes every cell of every layer is tested against every triangle. */
static bool is_everywhere(const tribox_options *options) { return options && options->axes && !(options->axes & TRIBOX_AXES_BOX); }

double layers_work_sample(const voxel_task *task)
{
    enum { BLOCKS = 16, FEW = 16 };
    double sum = 0;
    size_t seen = 0;
    if (is_everywhere(task->options))
        return (double)task->count * task->grid.size[1] * task->grid.size[2];
    for (size_t b = 0; b < BLOCKS; b++) {
        const size_t start = task->count / BLOCKS * b, left = task->count - start, count = left < FEW ? left : FEW;
        sum += layers_work_block(task, start, count).nanoseconds;
        seen += count;
    }
    return seen ? sum / (double)seen * (double)task->count : 0;
}

/* Equal parts of the layers: one layer each, or several. */
enum { BINS_MAX = 4096 };

static int bin_of(double place, uint32_t layers, int bins)
{
    const double bin = place * bins / layers;
    return !(bin > 0) ? 0 : bin < bins ? (int)bin : bins - 1;
}

/* Adds the work of a block to the rise of the work from bin to bin: it is spread over the block's layers. */
static void add_block(const tribox_grid *grid, uint32_t first, uint32_t layers, const layers_block *block, int bins, double *rise)
{
    const double lo = (block->lo - grid->origin[2]) / grid->cell[2] - first,
                 hi = (block->hi - grid->origin[2]) / grid->cell[2] - first;
    if (!(hi >= 0 && lo <= layers))
        return;
    const int from = bin_of(lo, layers, bins), to = bin_of(hi, layers, bins);
    const double in_bin = block->nanoseconds / (to - from + 1);
    rise[from] += in_bin;
    rise[to + 1] -= in_bin;
}

void layers_work_cut(const tribox_grid *grid, uint32_t first, uint32_t layers, const layers_block *blocks, size_t count, int slabs,
                     uint32_t *border)
{
    const int bins = layers < BINS_MAX ? (int)layers : BINS_MAX;
    double up_to[BINS_MAX + 1] = {0}, in_bin = 0, sum = 0;
    for (size_t b = 0; b < count; b++)
        add_block(grid, first, layers, &blocks[b], bins, up_to);
    for (int b = 0; b < bins; b++) {
        in_bin += up_to[b];
        sum += (in_bin > 0 ? in_bin : 0) + 1; /* a little for each, so that slabs without triangles have layers */
        up_to[b] = sum;
    }
    for (int s = 0, b = 0; s <= slabs; s++) {
        while (b < bins && up_to[b] < sum * s / slabs)
            b++;
        border[s] = (uint32_t)((uint64_t)layers * (uint64_t)b / (uint64_t)bins);
    }
    border[0] = 0;
    border[slabs] = layers;
}
