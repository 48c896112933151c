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

/* How a format is written; of frame, write and bricks there is one. */
typedef struct volume_writer {
    /* Begins what takes long and needs no grid; to be called before the mesh is read. NULL: nothing does. */
    void (*begin)(void);

    /* Refuses a grid that the format cannot hold. Returns an exit_code. NULL: it holds every grid. */
    int (*check_grid)(const char *path, const tribox_grid *grid);

    /* A dense format, which dense_write writes. */
    const volume_frame *frame;

    /* Another dense format. Stops where the stream fails, which ferror then reports. False, with errno, without memory. */
    bool (*write)(FILE *to, const voxels *v, progress *bar);

    /* A format that takes bricks as they come; see brick_out.h. */
    const struct brick_writer *bricks;
} volume_writer;

typedef struct volume_format {
    const char *word;   /* "npy" */
    const char *ending; /* ".npy" */
    const char *about;  /* for whom it is */
    const char *holds;  /* besides which cells are set: words with commas, as volume_holds takes them */
    const volume_writer *writer;
} volume_format;

/*
 * Every format, once: its word, its ending, for whom it is, and what it holds. Help, messages, completion and tribox(1) are made of
 * this, and its writer is volume_WORD, in a source of its own. Of two with one ending the first is the one that the ending stands
 * for.
 */
#define VOLUME_FORMATS(ROW) \
    ROW(npz, ".npz", "NumPy, bricks", "place, labels, ids, colours") \
    ROW(vdb, ".vdb", "OpenVDB", "place, labels, ids, colours") \
    ROW(npy, ".npy", "NumPy, all cells", "labels, ids") \
    ROW(cells, ".npy", "--out-format cells", "coordinates") \
    ROW(vti, ".vti", "ParaView", "place, labels, ids") \
    ROW(nrrd, ".nrrd", "3D Slicer", "place, labels, ids") \
    ROW(raw, ".raw", "bits", "labels, ids") \
    ROW(binvox, ".binvox", "cubes", "place") \
    ROW(vox, ".vox", "MagicaVoxel", "labels, colours of a palette") \
    ROW(ply, ".ply", "faces", "place, colours") \
    ROW(obj, ".obj", "faces", "place, colours") \
    ROW(glb, ".glb", "faces", "place, colours")

#define VOLUME_WRITER(word, ...) extern const volume_writer volume_##word;
VOLUME_FORMATS(VOLUME_WRITER)

/* Lines of help, as output_text takes them. */
#define VOLUME_HELP_ROW(word, ending, about, holds) "\t" ending " (" about ": " holds "),"
#define VOLUME_HELP VOLUME_FORMATS(VOLUME_HELP_ROW) "\tor as --out-format says\n"

/* A list of formats for messages: "npz, vdb or raw". */
typedef struct volume_list {
    char text[128];
} volume_list;

/* The words of those that hold this, or their endings; of all where it is NULL. */
volume_list volume_words(const char *holds);
volume_list volume_endings(const char *holds);

/* The format by the ending of the name, or by its word, such as "npy". Each returns NULL after a line on standard error. */
const volume_format *volume_format_of(const char *path);
const volume_format *volume_format_named(const char *word);

/* The format of row n, from 0; NULL behind the last. */
const volume_format *volume_format_at(size_t n);

/* Whether it holds "place": where the grid is, before any shift; "labels", "ids", "colours", or these "of a palette". */
bool volume_holds(const volume_format *format, const char *what);

/* "sparse": only cells that are set; "dense": all cells of the grid; "faces" between cells. */
const char *volume_kind(const volume_format *format);

/* Says where the cells are, if they are shifted and the format does not. NULL: nothing is written. */
void volume_note_shift(const volume_format *format, const char *path, const voxels *v);

#endif
