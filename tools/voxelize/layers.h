/*
 * layers.h - a soup, or a mesh of doubles, into layers of a grid by several threads.
 *
 * The layers are divided into slabs whose estimated work is about equal, by a histogram of the triangles over the layers. A thread
 * takes one slab after another and voxelizes it as a window of whole layers. A slab owns its words, so that the bits are the same
 * for every number of threads. No memory is allocated; the threads' stacks apart, some 40 KiB of stack are used.
 */
#ifndef LAYERS_H
#define LAYERS_H

#include <stdbool.h>

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

/*
 * Who gets layers as soon as they are done: from any of the threads, from several at once, each layer once. The words are the
 * thread's own and gone when it returns. False ends the work, which then returns TRIBOX_STOPPED. begin: whether a thread besides
 * the calling one has what it takes; else it leaves the layers to others.
 */
typedef struct layers_taker {
    bool (*begin)(void *data, unsigned thread);
    bool (*take)(void *data, unsigned thread, uint32_t first, uint32_t layers, const uint64_t *words);
    void *data;
} layers_taker;

/*
 * The same for all layers, the words of which nobody keeps: memory for some layers of each thread is all that it takes.
 * TRIBOX_STOPPED also where there is none.
 */
tribox_status voxelize_layers_apart(const voxel_task *task, unsigned threads, const layers_taker *taker, tribox_report *report,
                                    void (*progress)(void *data, double done), void *data);

/* Whether that takes less time: where there are many words, and most triangles reach few layers. */
bool layers_apart_pay(const voxel_task *task);

#endif
