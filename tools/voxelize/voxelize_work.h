/* voxelize_work.h - what tribox voxelize was asked, and the doing of it. */
#ifndef VOXELIZE_WORK_H
#define VOXELIZE_WORK_H

#include "grid_choice.h"
#include "picture/preview.h"
#include "write/volume.h"

typedef struct voxelize_request {
    const char *mesh_path, *out_path, *preview_path; /* preview_path: NULL for none */
    grid_choice grid;
    uint32_t threads;
    bool is_part;
    uint32_t shard, shards; /* 1 of 1 without --shard */
    picture_up up;
    tribox_options test;
    const volume_format *format; /* NULL for a part */
    bool wants_json, is_quiet;
} voxelize_request;

/* From the mesh to the files and the summary. Returns an exit_code. */
int voxelize_work(const voxelize_request *request);

#endif
