/*
 * layers.h - a soup, or a mesh of doubles, into all cells of a grid by several threads.
 *
 * The layers are divided into slabs whose estimated work is about equal, by a histogram of the triangles over the layers. A thread
 * takes one slab after another and voxelizes it as a window of whole layers. A slab owns its words, so that the bits are the same
 * for every number of threads. In a grid of few words each thread has words of its own.
 */
#ifndef LAYERS_H
#define LAYERS_H

#include "console/progress.h"
#include "voxel_task.h"

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
