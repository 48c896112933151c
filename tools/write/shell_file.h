/* shell_file.h - a shell as a file of a format of meshes. */
#ifndef SHELL_FILE_H
#define SHELL_FILE_H

#include <stdio.h>

#include "console/progress.h"
#include "shell_corners.h"

typedef struct shell_file {
    FILE *to;
    const char *path;
    const voxels *cells;
    const shell *shell;
    progress *bar;
    const shell_corners
        *corners; /* for formats that have colours at vertices alone; NULL: the shell's vertices are those of the file */
} shell_file;

/* From halves of cells to the coordinate before any shift: the planes are those of the grid, rounded once. */
double shell_file_coordinate(const voxels *v, int axis, uint32_t halves);

/* Each returns an exit_code; where the stream fails it stops, and ferror tells. */
int shell_write_ply(shell_file *f);
int shell_write_obj(shell_file *f);
int shell_write_glb(shell_file *f);

/* For them: how many vertices there are, and all of them in halves of cells, with their colours, where they have some. */
uint64_t shell_file_vertices(const shell_file *f);
bool shell_file_each_vertex(shell_file *f, bool (*take)(void *file, const uint32_t halves[3], rgb colour));

/* Hands over all triangles, until the stream fails. */
void shell_file_triangles(shell_file *f, shell_taker *take);

#endif
