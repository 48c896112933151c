/* volume.h - voxels as files of the formats that other programs read. */
#ifndef VOLUME_H
#define VOLUME_H

#include <stdio.h>

#include "console/progress.h"
#include "voxels.h"

typedef struct volume_format {
    const char *ending; /* ".npy" */

    /* Refuse a grid, or so many occupied cells, that the format cannot hold. Return an exit_code. NULL: it holds all. */
    int (*check_grid)(const char *path, const tribox_grid *grid);
    int (*check_cells)(const char *path, const tribox_grid *grid, uint64_t occupied);

    /* Writes layer by layer, in memory of a layer or two. Stops where the stream fails, which tells it by ferror. */
    void (*write)(FILE *to, const voxels *v, progress *bar);
} volume_format;

/* The format by the ending of the name. Returns NULL after a line on standard error. */
const volume_format *volume_format_of(const char *path);

/* NumPy 1.0: one bool a cell, shape (nz, ny, nx), so that array[k, j, i] is cell (i, j, k). */
void volume_write_npy(FILE *to, const voxels *v, progress *bar);

/* The words of tribox_voxelize, layer by layer, little-endian, and nothing else. */
void volume_write_raw(FILE *to, const voxels *v, progress *bar);

/* binvox 1: runs of equal cells, y fastest, then z, then x. The grid is filled up to a cube; cells have to be cubes. */
int volume_check_binvox(const char *path, const tribox_grid *grid);
void volume_write_binvox(FILE *to, const voxels *v, progress *bar);

/* MagicaVoxel 150: a list of cells; a grid with a side above 256 becomes several models, placed by a scene graph. */
int volume_check_vox(const char *path, const tribox_grid *grid, uint64_t occupied);
void volume_write_vox(FILE *to, const voxels *v, progress *bar);

#endif
