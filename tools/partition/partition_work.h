/* partition_work.h - a request of tribox partition, and the work that answers it. */
#ifndef PARTITION_WORK_H
#define PARTITION_WORK_H

#include "voxelize/grid_options.h"

typedef struct partition_request {
    grid_request from;
    const char **paths; /* meshes, or partitions of one grid; the first is that of `from` */
    size_t count;
    uint32_t threads;
    uint64_t memory; /* bytes; 0: a share of what there is */
    const char *out_path;
    bool has_ids; /* triangles keep their numbers */
    bool wants_json, is_quiet;
} partition_request;

/* From the meshes to the folder and the summary. Returns an exit_code. */
int partition_work(const partition_request *request);

#endif
