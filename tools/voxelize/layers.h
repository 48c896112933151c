/*
 * layers.h - a soup, or a mesh of doubles, into layers of a grid by several threads.
 *
 * The layers are divided into slabs whose estimated work is about equal, by a histogram of the triangles over the layers. A thread
 * takes one slab after another and voxelizes it as a window of whole layers. A slab owns its words, so that the bits are the same
 * for every number of threads. No memory is allocated; the threads' stacks apart, some 40 KiB of stack are used.
 */
#ifndef LAYERS_H
#define LAYERS_H

#include "console/processors.h"
#include "voxel_task.h"

/*
 * Does what tribox_voxelize does for a window of these layers, and returns what it returns; report as there.
 *
 * threads: how many work, the calling one among them: 1 to THREADS_MAX, other values count as the nearest of these. Where the
 * system starts fewer, those do all the work.
 * progress: NULL, or called with the share of the work done, 0 < done <= 1, rising; by any of the threads, but by one at a time.
 */
tribox_status voxelize_in_threads(const voxel_task *task, uint32_t first, uint32_t layers, unsigned threads, uint64_t *occupied,
                                  tribox_report *report, void (*progress)(void *data, double done), void *data);

#endif
