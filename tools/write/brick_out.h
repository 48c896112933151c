/* brick_out.h - a file of any format from bricks of 8 x 8 x 8 cells, handed over one at a time; and what a format does. */
#ifndef BRICK_OUT_H
#define BRICK_OUT_H

#include "file_out.h"
#include "volume.h"

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
    voxels cells;                   /* the grid and the shift, and in a dense format one slab with the words */
    uint64_t bricks;                /* put so far */
    uint64_t occupied;              /* cells in them, where the format counts them */
    unsigned threads;               /* that write a dense format; set it after brick_out_open, else one does */
    void *state;                    /* the format's own */
    const uint64_t *inside;         /* cells of the brick that is put which are inside, for labels; NULL without */
    const uint32_t *ids;            /* of its set cells, in the order of the bits; NULL without */
    const struct part_header *part; /* which part the bricks are, for .npz; set it after brick_out_open. NULL: the whole */
} brick_out;

/*
 * Starts the content of an open file. about: grid and shift of the whole; its slabs are not looked at. Returns an
 * exit_code, on failure after its line; nothing then needs to be dropped.
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

/* Each returns an exit_code, on failure after its line; that the stream failed, which ferror tells, needs no line. */
typedef struct brick_writer {
    bool goes_back;              /* it writes to places before the end, which standard output may not allow */
    int (*open)(brick_out *out); /* frees what it took if it fails */
    int (*put)(brick_out *out, const uint32_t at[3], const uint64_t bits[8]);
    int (*end)(brick_out *out, progress *bar);
    void (*drop)(brick_out *out);     /* frees the state */
    const struct shell_format *shell; /* of a format of meshes; NULL for others */
} brick_writer;

/*
 * Opens a nameless file, gone with the program, for what cannot go where it belongs yet: on the disk of the output; for standard
 * output where TMPDIR says, or in /tmp. NULL after a line.
 */
FILE *spool_open(const file_out *out);

/* What formats share that need the words of all cells at once. */
int gather_open(brick_out *out);
int gather_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8]);
void gather_drop(brick_out *out);

/*
 * What stands before the cells, all layers of these, and what stands after them: by threads, in any order, where the file has
 * places, else by one. Returns an exit_code.
 */
int dense_write(const volume_frame *frame, const file_out *file, const voxels *v, unsigned threads, progress *bar);

/* Writes the cells, one slab, which may stay where they are, as a mesh. */
int shell_end(brick_out *out, progress *bar);

/* An id for each cell of any format with a frame. */
extern const brick_writer gather_ids;

#endif
