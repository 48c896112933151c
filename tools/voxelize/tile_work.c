/* tile_work.c - estimates the work in each tile: what it costs by itself, by the rows that triangles cross, and by their reach. */
#include "tile_work.h"

#include <math.h>
#include <stdlib.h>

/* Nanoseconds, roughly: only their ratios matter. */
static const double tile_cost = 62000, row_cost = 10, reach_cost = 23;

/* In cells. */
static double place(const voxel_task *task, int a, double x) { return (x - task->grid.origin[a]) / task->grid.cell[a]; }

static double reach(const double x[3]) { return fmax(fmax(x[0], x[1]), x[2]) - fmin(fmin(x[0], x[1]), x[2]); }

/* Of the triangle seen along x: how many rows it crosses. */
static double area(const double y[3], const double z[3])
{
    return 0.5 * fabs((y[1] - y[0]) * (z[2] - z[0]) - (y[2] - y[0]) * (z[1] - z[0]));
}

/* What a triangle costs beyond the tiles that it is in, all of them together. */
static double triangle_work(const voxel_task *task, size_t t)
{
    double u[3][3];
    voxel_task_triangle(task, t, u);
    for (int a = 0; a < 3; a++)
        for (int v = 0; v < 3; v++)
            u[a][v] = place(task, a, u[a][v]);
    const double work = row_cost * area(u[1], u[2]) + reach_cost * (reach(u[0]) + reach(u[1]) + reach(u[2]));
    return isfinite(work) ? work : 0;
}

/* Replaces how many tiles a triangle is in by its work in each. */
static void share_work(const tile_set *set, double *share)
{
    const double most = 3 * row_cost * set->tile * set->tile;
    for (size_t t = 0; t < set->task.count; t++)
        if (share[t] > 0)
            share[t] = fmin(triangle_work(&set->task, t) / share[t], most);
}

bool tile_work_estimate(const tile_set *set, partition_tile *records)
{
    double *const share = calloc(set->task.count, sizeof *share);
    if (!share)
        return false;
    for (uint64_t p = 0; p < set->places; p++)
        share[set->list[p]]++;
    share_work(set, share);
    for (size_t r = 0; r < set->count; r++) {
        const size_t triangles = tile_set_triangles(set, r);
        const uint32_t *const list = set->list + records[r].first;
        double work = tile_cost;
        for (size_t i = 0; i < triangles; i++)
            work += share[list[i]];
        records[r].work = (uint64_t)work;
    }
    free(share);
    return true;
}
