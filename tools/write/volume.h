/* volume.h - voxels as files of the formats that other programs read. */
#ifndef VOLUME_H
#define VOLUME_H

#include <stdio.h>

#include "console/progress.h"
#include "voxels.h"

/* What some formats leave open. */
typedef struct volume_options {
    bool is_deflated; /* .npz: smaller, and slower to write */
    bool is_mask;     /* .vdb: a MaskGrid in place of a BoolGrid, smaller, and known to fewer programs */
    bool has_labels;  /* cells are 1 or 2, surface or inside */
    bool has_ids;     /* cells have the number of a triangle */
} volume_options;

/* A format whose cells lie one after the other: x fastest, then y, then z. */
typedef struct volume_frame {
    void (*before)(FILE *to, const voxels *v); /* what stands before them, and after them; NULL: nothing */
    void (*after)(FILE *to);
    bool has_words; /* without labels the words of tribox_voxelize, little-endian; else a byte for each cell, 1 where
                       it is set, 2 where it is labelled as inside */
} volume_frame;

/* What a format holds of the colours of cells. */
typedef enum volume_colours { VOLUME_NO_COLOURS, VOLUME_ANY_COLOURS, VOLUME_PALETTE } volume_colours;

typedef struct volume_format {
    const char *word;   /* "npy" */
    const char *ending; /* ".npy" */

    /* Begins what takes long and needs no grid; to be called before the mesh is read. NULL: nothing does. */
    void (*begin)(void);

    /* Refuses a grid that the format cannot hold. Returns an exit_code. NULL: it holds every grid. */
    int (*check_grid)(const char *path, const tribox_grid *grid);

    const volume_frame *frame; /* of a dense format, which dense_out.h writes; NULL for others */

    /* Another dense format: writes layer by layer. Stops where the stream fails, which ferror then reports. NULL for others. */
    void (*write)(FILE *to, const voxels *v, progress *bar);

    /* A sparse format: writes bricks as they come. NULL for a dense one. brick_out.h writes all. */
    const struct brick_writer *bricks;

    volume_colours colours;
    bool has_place;    /* it says where the grid is, which is where the mesh was before it was shifted */
    bool takes_labels; /* it can tell cells of the surface from those inside */
} volume_format;

/* For the help text and for messages. */
#define VOLUME_WORDS "npz, vdb, cells, npy, vti, nrrd, binvox, vox, raw, ply, obj, glb"
#define VOLUME_ENDINGS ".npz, .vdb, .npy, .vti, .nrrd, .binvox, .vox, .raw, .ply, .obj or .glb"
#define VOLUME_LABELLED "npz, vdb, npy, vti, nrrd, vox or raw"
#define VOLUME_WITH_IDS ".npz, .vdb, .npy, .vti, .nrrd or .raw"

/* The format by the ending of the name, or by its word, such as "npy". Each returns NULL after a line on standard error. */
const volume_format *volume_format_of(const char *path);
const volume_format *volume_format_named(const char *word);

/* Whether it has a place for the id of each cell. */
bool volume_takes_ids(const volume_format *format);

/* Says where the cells are, if they are shifted and the format does not. NULL: nothing is written. */
void volume_note_shift(const volume_format *format, const char *path, const voxels *v);

/* NumPy 1.0: one bool per cell, or label of uint8, shape (nz, ny, nx), so that array[k, j, i] is cell (i, j, k). */
extern const volume_frame volume_npy;

/* The words of tribox_voxelize, layer by layer, little-endian, and nothing else; labels as a byte for each cell. */
extern const volume_frame volume_raw;

/* VTK's XML image, 1.0: a cell of unsigned char for each cell, appended raw. */
extern const volume_frame volume_vti;

/* NRRD 4: an unsigned char for each cell, raw, with the directions and the origin of the space. */
extern const volume_frame volume_nrrd;

/* binvox 1: runs of equal cells, y fastest, then z, then x. Empty cells fill the grid up to a cube; cells must be cubes. */
int volume_check_binvox(const char *path, const tribox_grid *grid);
void volume_write_binvox(FILE *to, const voxels *v, progress *bar);

/* MagicaVoxel 150: one model, a list of cells; at most 256 cells on each axis. Labels have colours of their own. */
int volume_check_vox(const char *path, const tribox_grid *grid);
void volume_write_vox(FILE *to, const voxels *v, progress *bar);

#endif
