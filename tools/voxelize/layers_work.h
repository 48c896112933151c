/* layers_work.h - an estimate of how the work of a voxelization is spread over the layers. */
#ifndef LAYERS_WORK_H
#define LAYERS_WORK_H

#include "voxel_task.h"

enum { LAYERS_BINS_MAX = 4096 };

typedef struct layers_work {
    int bins;                      /* equal parts of the layers: one layer each, or several */
    double up_to[LAYERS_BINS_MAX]; /* the work of all bins up to this one, in nanoseconds, roughly */
} layers_work;

/* Looks at a sample of the triangles. The task is sound, and layers > 0. */
void layers_work_estimate(const voxel_task *task, uint32_t first, uint32_t layers, layers_work *work);

double layers_work_total(const layers_work *work);

/* How many of the layers take this share (0 to 1) of the work. */
uint32_t layers_work_share(const layers_work *work, uint32_t layers, double share);

#endif
