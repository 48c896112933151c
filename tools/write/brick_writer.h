/* brick_writer.h - what a format does with bricks; brick_out.c calls it. */
#ifndef BRICK_WRITER_H
#define BRICK_WRITER_H

#include "brick_out.h"

/* Each returns an exit_code, on failure after its line; that the stream failed, which ferror tells, needs no line. */
typedef struct brick_writer {
    bool goes_back;              /* it writes to places before the end, which standard output may not allow */
    int (*open)(brick_out *out); /* frees what it took if it fails */
    int (*put)(brick_out *out, const uint32_t at[3], const uint64_t bits[8]);
    int (*end)(brick_out *out, progress *bar);
    void (*drop)(brick_out *out);     /* frees the state */
    const struct shell_format *shell; /* of a format of meshes; NULL for others */
} brick_writer;

/* What formats share that need the words of all cells at once. */
int gather_open(brick_out *out);
int gather_put(brick_out *out, const uint32_t at[3], const uint64_t bits[8]);
void gather_drop(brick_out *out);

/* Writes the cells, one slab, which may stay where they are, as a mesh. */
int shell_end(brick_out *out, progress *bar);

/* Arrays of NumPy's: at[n, 3], bits[n, 8], origin, cell, size and shift. The check refuses where zlib is not there. */
extern const brick_writer bricks_npz;
int bricks_check_npz(const char *path, const tribox_grid *grid);

/* An id for each cell of any format with a frame. */
extern const brick_writer gather_ids;

/* An array of NumPy's: the coordinates of cells, [n, 3]. */
extern const brick_writer bricks_cells;

/*
 * OpenVDB's BoolGrid or MaskGrid. The check finds out whether OpenVDB is there, which takes a while: it may begin before there is a
 * grid.
 */
extern const brick_writer bricks_vdb;
void bricks_begin_vdb(void);
int bricks_check_vdb(const char *path, const tribox_grid *grid);

/*
 * The surface of the cells as a mesh: Stanford's polygons, Wavefront's text, glTF's binary. The checks refuse what memory does not
 * hold.
 */
extern const brick_writer bricks_ply, bricks_obj, bricks_glb;
int bricks_check_shell(const char *path, const tribox_grid *grid);
int bricks_check_glb(const char *path, const tribox_grid *grid);

#endif
