/* voxelize_ways.h - the ways from a mesh to a file: the whole grid in memory, and tile by tile. */
#ifndef VOXELIZE_WAYS_H
#define VOXELIZE_WAYS_H

#include "colours/mesh_colours.h"
#include "partition/partition.h"
#include "voxel_task.h"
#include "voxelize_report.h"
#include "voxelize_work.h"
#include "write/file_out.h"

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

/* Says in the answer how it was filled, and warns of a mesh that is not closed. */
void voxelize_note_fill(const voxelize_request *r, size_t odd_rows, voxelize_answer *a);

/* Tile by tile, for what needs no words of the whole grid. Returns an exit_code. */
int voxelize_by_tiles(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a);

#endif
