/* partition_make.h - from meshes, or partitions of one grid, to the partition of them all. */
#ifndef PARTITION_MAKE_H
#define PARTITION_MAKE_H

#include "partition.h"
#include "voxelize/grid_options.h"
#include "write/file_out.h"

typedef struct partition_request {
    grid_request from;
    const char *const *paths; /* meshes, or partitions of one grid; the first is that of `from` */
    size_t count;
    uint32_t threads;
    uint64_t memory; /* bytes; 0: a share of what there is */
    const char *out_path;
    const char *told;          /* NULL, or what messages call a partition that is used and dropped, and never kept as out_path */
    const char *name;          /* NULL, or what messages call the mesh */
    bool has_ids;              /* triangles keep their numbers */
    bool wants_json, is_quiet; /* what is printed of it */
} partition_request;

typedef struct partition_answer {
    const partition_request *r;
    voxels cells;
    bool is_shifted;
    partition_header header;
    folder_out out;
    uint64_t spilled; /* bytes that went through files beside it */
    double seconds;
} partition_answer;

/*
 * Writes the folder out_path, which must not be there yet; or, with `told`, one beside such a name: out.beside, to be dropped. Of a
 * the request is set. Returns an exit_code; on failure nothing is left.
 */
int partition_make(partition_answer *a);

#endif
