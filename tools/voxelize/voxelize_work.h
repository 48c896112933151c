/* voxelize_work.h - a request of tribox voxelize, and the work that answers it. */
#ifndef VOXELIZE_WORK_H
#define VOXELIZE_WORK_H

#include "fill/fill_kinds.h"
#include "grid_options.h"
#include "result_options.h"

typedef struct voxelize_request {
    grid_request from;  /* the mesh may be a partition, which has its grid */
    const char **paths; /* of it, or of several partitions: `count` */
    size_t count;
    uint32_t threads;
    bool is_count;          /* nothing is written */
    uint32_t shard, shards; /* 1 of 1 without --shard */
    bool has_shard;
    bool is_thin; /* cells of a thin surface, which all are in memory */
    voxelize_fill fill;
    fill_cells cells; /* of a fill */
    bool has_colours; /* of the mesh's triangles, for the cells */
    tribox_options test;
    result_request result;
} voxelize_request;

/* From the mesh to the files and the summary. Returns an exit_code. */
int voxelize_work(const voxelize_request *request);

#endif
