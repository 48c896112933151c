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

    const volume_frame *frame; /* of a dense format, which dense_write writes; NULL for others */

    /* Another dense format: writes layer by layer. Stops where the stream fails, which ferror then reports. NULL for others. */
    void (*write)(FILE *to, const voxels *v, progress *bar);

    /* A sparse format: writes bricks as they come. NULL for a dense one. brick_out.h writes all. */
    const struct brick_writer *bricks;

    volume_colours colours;
    bool has_place;    /* it says where the grid is, which is where the mesh was before it was shifted */
    bool takes_labels; /* it can tell cells of the surface from those inside */
} volume_format;

/*
 * Every format, once: its word, its ending, what the help says of it and how that goes on, and the rest of its row. Of two with one
 * ending the first is the one that the ending stands for.
 */
#define VOLUME_FORMATS(ROW) \
    ROW("npz", ".npz", " (NumPy, bricks; colours, labels, ids)", ", ", .check_grid = bricks_check_npz, .bricks = &bricks_npz, \
        .colours = VOLUME_ANY_COLOURS, .has_place = true, .takes_labels = true) \
    ROW("vdb", ".vdb", " (OpenVDB; the same)", ",\n            ", .begin = bricks_begin_vdb, .check_grid = bricks_check_vdb, \
        .bricks = &bricks_vdb, .colours = VOLUME_ANY_COLOURS, .has_place = true, .takes_labels = true) \
    ROW("npy", ".npy", " (NumPy; labels, ids)", ", ", .frame = &volume_npy, .takes_labels = true) \
    ROW("cells", ".npy", " of coordinates by --out-format cells", ",\n            ", .bricks = &bricks_cells) \
    ROW("vti", ".vti", " (ParaView)", ", ", .frame = &volume_vti, .has_place = true, .takes_labels = true) \
    ROW("nrrd", ".nrrd", " (3D Slicer)", ", ", .frame = &volume_nrrd, .has_place = true, .takes_labels = true) \
    ROW("raw", ".raw", " (bits; all three with labels, ids)", ", ", .frame = &volume_raw, .takes_labels = true) \
    ROW("binvox", ".binvox", "", ",\n            ", .check_grid = volume_check_binvox, .write = volume_write_binvox, \
        .has_place = true) \
    ROW("vox", ".vox", " (MagicaVoxel; colours, labels)", ", ", .check_grid = volume_check_vox, .write = volume_write_vox, \
        .colours = VOLUME_PALETTE, .takes_labels = true) \
    ROW("ply", ".ply", "", ", ", .check_grid = bricks_check_shell, .bricks = &bricks_ply, .colours = VOLUME_ANY_COLOURS, \
        .has_place = true) \
    ROW("obj", ".obj", "", " and ", .check_grid = bricks_check_shell, .bricks = &bricks_obj, .colours = VOLUME_ANY_COLOURS, \
        .has_place = true) \
    ROW("glb", ".glb", " (faces of cells; colours)", "\n", .check_grid = bricks_check_glb, .bricks = &bricks_glb, \
        .colours = VOLUME_ANY_COLOURS, .has_place = true)

/* Lines of help. */
#define VOLUME_HELP_ROW(word, ending, about, next, ...) ending about next
#define VOLUME_HELP VOLUME_FORMATS(VOLUME_HELP_ROW)

/* A list of formats for messages: "npz, vdb or raw". */
typedef struct volume_list {
    char text[128];
} volume_list;

/* The words of those that are taken, or their endings; of all where takes is NULL. */
volume_list volume_words(bool (*takes)(const volume_format *format));
volume_list volume_endings(bool (*takes)(const volume_format *format));

/* The format by the ending of the name, or by its word, such as "npy". Each returns NULL after a line on standard error. */
const volume_format *volume_format_of(const char *path);
const volume_format *volume_format_named(const char *word);

/* Whether it has a place for the id of each cell, for labels, and for colours. */
bool volume_takes_ids(const volume_format *format);
bool volume_takes_labels(const volume_format *format);
bool volume_takes_colours(const volume_format *format);

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
