/* tile_work.c - estimates the work in each tile: what it costs by itself, by the rows that triangles cross, and by their reach. */
#include "tile_set.h"

#include <math.h>
#include <stdlib.h>

/* Nanoseconds, roughly: only their ratios matter. */
static const double row_cost = 10, reach_cost = 23;

static double least(double a, double b) { return a < b ? a : b; }
static double most_of(double a, double b) { return a > b ? a : b; }

/* Of a vertex and the two that lie so far from it. */
static double reach(double a, double b) { return most_of(most_of(a, b), 0) - least(least(a, b), 0); }

uint64_t tile_work_of(const tribox_grid *grid, uint32_t side, const double u[9], uint32_t tiles)
{
    const double most = 3 * row_cost * side * side;
    double e[3], f[3]; /* two edges, in cells */
    for (int a = 0; a < 3; a++) {
        e[a] = (u[3 + a] - u[a]) / grid->cell[a];
        f[a] = (u[6 + a] - u[a]) / grid->cell[a];
    }
    /* Seen along x: how many rows it crosses. */
    const double area = 0.5 * fabs(e[1] * f[2] - f[1] * e[2]);
    const double work = row_cost * area + reach_cost * (reach(e[0], f[0]) + reach(e[1], f[1]) + reach(e[2], f[2]));
    const double share = ceil(work / tiles);
    return share < most ? (uint64_t)share : isfinite(share) ? (uint64_t)most : 0;
}

/* Replaces how many tiles a triangle is in by its work in each. */
static void share_work(const tile_set *set, uint32_t *share)
{
    for (size_t t = 0; t < set->task.count; t++)
        if (share[t]) {
            double u[3][3], by_vertex[9];
            voxel_task_triangle(&set->task, t, u);
            for (int k = 0; k < 9; k++)
                by_vertex[k] = u[k % 3][k / 3];
            share[t] = (uint32_t)tile_work_of(&set->task.grid, set->tile, by_vertex, share[t]);
        }
}

bool tile_work_estimate(const tile_set *set, partition_tile *records)
{
    uint32_t *const share = calloc(set->task.count, sizeof *share);
    if (!share)
        return false;
    for (uint64_t p = 0; p < set->places; p++)
        share[set->list[p]]++;
    share_work(set, share);
    for (size_t r = 0; r < set->count; r++) {
        const size_t triangles = tile_set_triangles(set, r);
        const uint32_t *const list = set->list + records[r].first;
        records[r].work = TILE_WORK;
        for (size_t i = 0; i < triangles; i++)
            records[r].work += share[list[i]];
    }
    free(share);
    return true;
}
