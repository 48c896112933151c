/* voxelize_work.h - a request of tribox voxelize, and the work that answers it. */
#ifndef VOXELIZE_WORK_H
#define VOXELIZE_WORK_H

#include "grid_choice.h"
#include "read/mesh_shift.h"
#include "result_options.h"

typedef struct voxelize_request {
    const char *mesh_path;
    triangle_format format; /* of the mesh; OTHER to go by its name */
    mesh_shift shift;
    grid_choice grid;
    uint32_t threads;
    bool is_part;
    uint32_t shard, shards; /* 1 of 1 without --shard */
    tribox_options test;
    result_request result;
} voxelize_request;

/* From the mesh to the files and the summary. Returns an exit_code. */
int voxelize_work(const voxelize_request *request);

#endif
