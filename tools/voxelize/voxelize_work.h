/* voxelize_work.h - a request of tribox voxelize, and the ways to its answer: the whole grid in memory, and tile by tile. */
#ifndef VOXELIZE_WORK_H
#define VOXELIZE_WORK_H

#include "colours/colours.h"
#include "fill/fill_tiles.h"
#include "grid_options.h"
#include "partition/partition.h"
#include "result_options.h"
#include "voxel_task.h"
#include "write/file_out.h"

typedef struct voxelize_request {
    grid_request from;        /* the mesh may be a partition, which has its grid */
    const char *const *paths; /* of it, or of several partitions: `count` */
    size_t count;
    uint32_t threads;
    uint64_t memory;        /* bytes that the mesh may take before it is sorted; 0: a share of what there is */
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

typedef struct voxelize_answer {
    const voxelize_request *r;
    size_t triangles, not_finite;
    bool is_double; /* the mesh has coordinates that float does not hold */
    bool is_shifted;
    voxels cells;    /* the grid and the shift alone */
    uint32_t tile;   /* cells along a side of the tiles; 0: in one piece */
    bool has_bricks; /* they were counted */
    uint64_t bricks;
    size_t from_tile, tiles; /* of a shard */
    const char *colours;     /* whose they are; NULL for none */
    size_t inside, odd_rows; /* of a fill */
    tribox_report report;
    double seconds, total_seconds; /* of the cells; from the first byte of the mesh to the last that is written */
} voxelize_answer;

/* What there is to voxelize: a mesh, or a partition. */
typedef struct voxelize_input {
    const mesh *mesh;            /* NULL for a partition */
    const mesh_colours *colours; /* of its triangles, where the cells get them; else NULL */
    const partition *partition;  /* NULL for a mesh */
    voxels cells;                /* the grid and the shift */
} voxelize_input;

/* The files, open where they are wanted. */
typedef struct voxelize_files {
    file_out out, picture;
} voxelize_files;

/* A mesh into the words of its whole grid, filled if that is wanted, and into files. Returns an exit_code. */
int voxelize_whole(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a);

/* The mesh as what is to be voxelized into this grid. */
voxel_task voxelize_task(const voxelize_request *r, const voxelize_input *in);

/* Notes rows of cells that cross the mesh an odd number of times, and warns that it is not closed. */
void voxelize_note_rows(size_t odd_rows, voxelize_answer *a);

/* Tile by tile, for what needs no words of the whole grid. Returns an exit_code. */
int voxelize_by_tiles(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a);

/* Prints the answer and flushes the output. Returns an exit_code. */
int voxelize_report(const voxelize_answer *a);

/* Whether the answer would be the same of a mesh that is sorted into a partition first. */
bool voxelize_can_sort(const voxelize_request *r);

/* From the mesh to the files and the summary. Returns an exit_code. */
int voxelize_work(const voxelize_request *request);

#endif
