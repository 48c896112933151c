/* shell_file.h - a shell as a file of a format of meshes. */
#ifndef SHELL_FILE_H
#define SHELL_FILE_H

#include <stdio.h>

#include "console/progress.h"
#include "shell/shell.h"

/* A vertex where each has one colour: one that faces of several colours share is as many. */
typedef struct shell_corner {
    uint32_t vertex; /* of the shell */
    uint32_t next;   /* another corner of that; UINT32_MAX: none */
    rgb colour;
} shell_corner;

typedef struct shell_corners {
    uint32_t (*places)[3]; /* of the shell's vertices, in halves of cells */
    uint32_t *first;       /* corner of each of them */
    shell_corner *of;      /* in the order in which triangles come to them */
    size_t count, room;
    bool lacks_memory;
} shell_corners;

typedef struct shell_file {
    FILE *to;
    const char *path;
    const voxels *cells;
    const shell *shell;
    progress *bar;
    const struct shell_format *format;
    uint64_t vertices;            /* of the file */
    const shell_corners *corners; /* NULL: the shell's vertices are those of the file */
    void *state;                  /* the format's own */
} shell_file;

typedef struct shell_format {
    bool has_corners;                                                    /* it has colours at vertices alone */
    int (*begin)(shell_file *f);                                         /* writes what stands first. Returns an exit_code */
    void (*vertex)(shell_file *f, const uint32_t halves[3], rgb colour); /* in halves of cells; colour: of a corner */
    void (*triangle)(shell_file *f, const uint32_t triangle[3], rgb colour);
    void (*end)(shell_file *f); /* frees the state, after a failure to begin too; NULL: there is none */
} shell_format;
extern const shell_format shell_ply, shell_obj, shell_glb;

/* From halves of cells to the coordinate before any shift: the planes are those of the grid, rounded once. */
double shell_file_coordinate(const voxels *v, int axis, uint32_t halves);

#endif
