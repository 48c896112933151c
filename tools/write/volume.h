/* volume.h - voxels as files of the formats that other programs read; written from bricks handed over one at a time, or at once. */
#ifndef VOLUME_H
#define VOLUME_H

#include "console/message.h"
#include "console/progress.h"
#include "file_out.h"
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
    bool has_words; /* without labels those of tribox_voxelize, little-endian; else a byte for each cell: 1, or 2 inside */
} volume_frame;

struct brick_out;

/* How a format is written. What returns an int returns an exit_code, on failure after its line. */
typedef struct volume_writer {
    void (*begin)(void); /* begins what takes long and needs no grid, before the mesh is read; NULL: nothing does */
    int (*check_grid)(const char *path, const tribox_grid *grid); /* refuses one that the format cannot hold; NULL: it holds all */

    /* A format of all cells at once. It stops where the stream fails, which ferror then reports. */
    int (*write_all)(struct brick_out *out, progress *bar);
    const volume_frame *frame;        /* for dense_write */
    const struct shell_format *shell; /* for shell_write, whose files are meshes */

    /* Another takes bricks as they come. That the stream failed needs no line. */
    bool goes_back;                     /* it writes to places before the end, which standard output may not allow */
    int (*open)(struct brick_out *out); /* frees what it took if it fails */
    int (*put)(struct brick_out *out, const uint32_t at[3], const uint64_t bits[8]);
    int (*end)(struct brick_out *out, progress *bar);
    void (*drop)(struct brick_out *out); /* frees the state; NULL: there is none */
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

/* Sparse: only cells that are set; dense: all cells of the grid; faces between cells. */
typedef enum volume_kind { VOLUME_SPARSE, VOLUME_DENSE, VOLUME_FACES } volume_kind;
volume_kind volume_kind_of(const volume_format *format);

/* Says where the cells are, if they are shifted and the format does not. NULL: nothing is written. */
void volume_note_shift(const volume_format *format, const char *path, const voxels *v);

/* ----------------------------------------------------------------------------------------------------------------------- output */

struct part_header;

/*
 * Sparse formats (.npz, .vdb, cells) take memory for what their file needs at once: nothing but a buffer, or for .vdb the bricks
 * themselves. Dense formats take the words of the whole grid. Where a number has to stand before what it counts it is filled in at
 * the end, in a nameless file where the output cannot go back.
 */
typedef struct brick_out {
    const volume_format *format;
    volume_options options;
    file_out *file;
    FILE *to;                       /* where the bytes go: the file's own stream, or a nameless file for one that cannot go back */
    voxels cells;                   /* the grid and the shift, and in a format of all cells their words */
    uint64_t bricks;                /* put so far */
    uint64_t occupied;              /* cells in them, where the format counts them */
    unsigned threads;               /* that write a dense format; set it after brick_out_open, else one does */
    void *state;                    /* the format's own */
    const uint64_t *inside;         /* cells of the brick that is put which are inside, for labels; NULL without */
    const uint32_t *ids;            /* of its set cells, in the order of the bits; NULL without */
    const struct part_header *part; /* which part the bricks are, for .npz; set it after brick_out_open. NULL: the whole */
} brick_out;

/*
 * Starts the content of an open file. about: grid and shift of the whole; its words are not looked at. Returns an exit_code, on
 * failure after its line; nothing then needs to be dropped.
 */
int brick_out_open(brick_out *out, const volume_format *format, const volume_options *options, file_out *file, const voxels *about);

/*
 * Adds a brick as a tribox_sink is handed it: in any order, each place once, one call at a time. Bits of cells outside the grid are
 * to be 0. Returns an exit_code; after a failure, which has said its line, brick_out_drop is all that is left.
 */
int brick_out_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8]);

/* Writes the rest and frees all memory; file_out_keep is the caller's next step. Returns an exit_code; on failure as for put. */
int brick_out_end(brick_out *out, progress *bar);

/* Frees the memory of what did not come to its end; nothing after brick_out_end has succeeded. The file is the caller's to drop. */
void brick_out_drop(brick_out *out);

/*
 * Writes voxels in memory in any format, dense or sparse, whose bricks come in the order of these tiles, 0: of the whole. threads:
 * that write a dense format. bricks: how many a sparse format got. Returns an exit_code.
 */
int brick_out_voxels(const volume_format *format, const volume_options *options, file_out *file, const voxels *v, uint32_t tile,
                     unsigned threads, uint64_t *bricks, progress *bar);

/* Little-endian, eight at most. */
bool volume_put_numbers(FILE *to, const uint32_t *number, size_t count);

/* All cells between what stands before them and after them: by threads, in any order, where the file has places, else by one. */
int dense_write(brick_out *out, progress *bar);

#endif
