/* voxel_task.h - triangles and a grid: a soup, or a mesh of doubles; and all of its cells at once, by several threads. */
#ifndef VOXEL_TASK_H
#define VOXEL_TASK_H

#include <stdbool.h>

#include "console/progress.h"
#include "tribox.h"

typedef struct voxel_task {
    const tribox_soup *soup; /* NULL: the mesh counts, of doubles one after the other and indices of 32 bits */
    const tribox_mesh *mesh;
    size_t count; /* of the triangles */
    tribox_grid grid;
    const tribox_options *options;
    bool is_thin; /* the cells of tribox_voxelize_thin, in words alone: tiles have none */
    bool has_ids; /* of each cell, in tiles alone */
} voxel_task;

voxel_task voxel_task_of_soup(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options);

/* tribox_tile_lists_part of these triangles. */
tribox_status voxel_task_lists(const voxel_task *task, size_t first, size_t count, const tribox_tiles *tiles,
                               const tribox_options *options, size_t *places, uint32_t *list);

/* The coordinates of triangle t: u[a][v] of vertex v on axis a. */
void voxel_task_triangle(const voxel_task *task, size_t t, double u[3][3]);

/*
 * Does what tribox_voxelize does for the whole grid, which it serves, and returns what it returns; report as there.
 *
 * threads: how many work, the calling one among them: 1 to THREADS_MAX, other values count as the nearest of these. Where the
 * system starts fewer, or there is little memory, fewer do all the work.
 * bar: NULL for none.
 */
tribox_status voxelize_in_threads(const voxel_task *task, unsigned threads, uint64_t *occupied, tribox_report *report,
                                  progress *bar);

#endif
