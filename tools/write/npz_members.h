/* npz_members.h - the arrays of a .npz file of bricks that stand beside the bricks. */
#ifndef NPZ_MEMBERS_H
#define NPZ_MEMBERS_H

#include "part.h"
#include "voxels.h"
#include "zip_out.h"

/* The arrays that have a row for each brick, or for each set cell. */
enum { NPZ_BITS, NPZ_AT, NPZ_IDS, NPZ_ARRAYS };
typedef struct npz_array {
    const char *name, *type;
    int columns, row_bytes;
} npz_array;
extern const npz_array npz_arrays[NPZ_ARRAYS];

/* The header of an array of so many rows; columns: 0 for a number each. */
void npz_rows(unsigned char header[NPY_HEADER], const char *type, uint64_t rows, int columns);

/* origin, cell, size and shift. */
void npz_add_grid(zip_out *zip, const voxels *v);

/* shard, tiles and whole: which part the file is, and of what. */
void npz_add_part(zip_out *zip, const part_header *header);

#endif
