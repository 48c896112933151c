/* npz.h - the arrays of a .npz file of bricks. */
#ifndef NPZ_H
#define NPZ_H

#include "part.h"

/* Those that have a row for each brick, or for each set cell; then what the file says of the grid, and of its place in a whole. */
enum {
    NPZ_BITS,
    NPZ_AT,
    NPZ_MORE, /* one of the next three, of which a part has ids alone */
    NPZ_IDS = NPZ_MORE,
    NPZ_ARRAYS,
    NPZ_INSIDE = NPZ_ARRAYS,
    NPZ_COLOURS,
    NPZ_ORIGIN,
    NPZ_CELL,
    NPZ_SIZE,
    NPZ_SHIFT,
    NPZ_SHARD,
    NPZ_TILES,
    NPZ_WHOLE,
    NPZ_END,
    NPZ_NUMBERS_MOST = 7
};

typedef struct npz_array {
    const char *name, *type;
    int columns; /* of a row; 0: a number each */
    int row_bytes;
    unsigned rows; /* 0: as many as bricks or cells */
} npz_array;
extern const npz_array npz_arrays[NPZ_END];

/* The numbers of arrays from NPZ_ORIGIN on, as bits. */
typedef struct npz_about {
    uint64_t of[NPZ_END][NPZ_NUMBERS_MOST];
} npz_about;

/* The header of an array of so many rows. */
void npz_header(unsigned char header[NPY_HEADER], int array, uint64_t rows);

/* Writes grid and shift, and, if not NULL, which part the file is, and of what. */
void npz_add_about(zip_out *zip, const voxels *v, const part_header *of);

/* Takes them. False where numbers make no sense even before they are looked at. */
bool npz_take_about(part_header *to, const npz_about *about);

#endif
