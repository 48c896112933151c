/* layers_work.c - estimates the work in each layer: what a triangle costs by itself and by the rows of cells that it meets. */
#include "layers_work.h"

#include <math.h>
#include <stdbool.h>

/* About how many triangles are looked at; all of them would cost as much as voxelizing small ones. */
enum { SAMPLE = 1 << 12 };

/* Nanoseconds, roughly: only their ratio matters to the balance, their size to the number of slabs. */
static const double triangle_cost = 6, row_cost = 7, empty_layer_cost = 100;

/* For fmin and fmax compilers call libm. */
static double lesser(double a, double b) { return a < b ? a : b; }
static double greater(double a, double b) { return a > b ? a : b; }

typedef struct interval {
    double lo, hi;
} interval;

/* In cells. */
static double place(const voxel_task *task, int a, double x) { return (x - task->grid.origin[a]) / task->grid.cell[a]; }

static interval interval_of(const double x[3])
{
    return (interval){lesser(lesser(x[0], x[1]), x[2]), greater(greater(x[0], x[1]), x[2])};
}

/* Twice the area of the triangle seen along x, in cells. */
static double twice_area(const double y[3], const double z[3])
{
    return fabs((y[1] - y[0]) * (z[2] - z[0]) - (y[2] - y[0]) * (z[1] - z[0]));
}

static bool meets(interval i, double size) { return i.hi >= 0 && i.lo <= size; }

static void add_triangle(const voxel_task *task, size_t t, uint32_t first, uint32_t layers, int bins, double *rise)
{
    double u[3][3], x[3], y[3], z[3], sum = 0;
    voxel_task_triangle(task, t, u);
    for (int v = 0; v < 3; v++) {
        x[v] = place(task, 0, u[0][v]);
        y[v] = place(task, 1, u[1][v]);
        z[v] = place(task, 2, u[2][v]) - first;
        sum += x[v] + y[v] + z[v];
    }
    const interval ix = interval_of(x), iy = interval_of(y), iz = interval_of(z);
    if (!isfinite(sum) || !meets(ix, task->grid.size[0]) || !meets(iy, task->grid.size[1]) || !meets(iz, layers))
        return;
    const double height = floor(iz.hi) - floor(iz.lo) + 1;
    const double rows = 0.5 * twice_area(y, z) + (iy.hi - iy.lo) + height;
    const double per_layer = triangle_cost / height + row_cost * lesser(rows / height, task->grid.size[1]);
    const double bin_of_layer = (double)bins / layers;
    const int from = (int)(greater(iz.lo, 0) * bin_of_layer), to = (int)(lesser(iz.hi, layers) * bin_of_layer);
    const double in_bin = per_layer * lesser(height, 1 / bin_of_layer);
    rise[from < bins ? from : bins - 1] += in_bin;
    if (to + 1 < bins)
        rise[to + 1] -= in_bin;
}

/* Without the box axes every cell of every layer is tested against every triangle. */
static bool is_everywhere(const tribox_options *options) { return options && options->axes && !(options->axes & TRIBOX_AXES_BOX); }

void layers_work_estimate(const voxel_task *task, uint32_t first, uint32_t layers, layers_work *work)
{
    work->bins = layers < LAYERS_BINS_MAX ? (int)layers : LAYERS_BINS_MAX;
    for (int b = 0; b < work->bins; b++)
        work->up_to[b] = 0;
    double scale = 1, least = empty_layer_cost * layers / work->bins;
    if (is_everywhere(task->options)) {
        least += (double)task->count * row_cost * task->grid.size[1] * layers / work->bins;
    } else {
        const size_t stride = task->count / SAMPLE | 1; /* odd: quads are often two triangles each */
        for (size_t t = 0; t < task->count; t += stride)
            add_triangle(task, t, first, layers, work->bins, work->up_to);
        scale = (double)stride;
    }
    double in_bin = 0, sum = 0;
    for (int b = 0; b < work->bins; b++) {
        in_bin += work->up_to[b];
        sum += scale * greater(in_bin, 0) + least;
        work->up_to[b] = sum;
    }
}

double layers_work_total(const layers_work *work) { return work->up_to[work->bins - 1]; }

uint32_t layers_work_share(const layers_work *work, uint32_t layers, double share)
{
    const double wanted = share * layers_work_total(work);
    int b = 0;
    while (b < work->bins - 1 && work->up_to[b] < wanted)
        b++;
    const double before = b ? work->up_to[b - 1] : 0;
    const double bins = b + (wanted - before) / (work->up_to[b] - before);
    const double count = round(bins * layers / work->bins);
    return count < 0 ? 0 : count > layers ? layers : (uint32_t)count;
}
