/* npz_members.h - the arrays of a .npz file of bricks that stand beside the bricks. */
#ifndef NPZ_MEMBERS_H
#define NPZ_MEMBERS_H

#include "part.h"
#include "voxels.h"
#include "zip_out.h"

/* The header of an array of so many rows; columns: 0 for a number each. */
void npz_rows(unsigned char header[NPY_HEADER], const char *type, uint64_t rows, int columns);

/* origin, cell, size and shift. */
void npz_add_grid(zip_out *zip, const voxels *v);

/* shard, tiles and whole: which part the file is, and of what. */
void npz_add_part(zip_out *zip, const part_header *header);

#endif
