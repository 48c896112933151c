/* part.h - a .npz file of the bricks that one of several runs has found, "shard 2 of 8", or of all: what tribox merge reads. */
#ifndef PART_H
#define PART_H

#include <stdbool.h>

#include "checksum.h"
#include "colours/rgb.h"
#include "console/progress.h"
#include "file_out.h"
#include "read/mesh.h"
#include "voxels.h"
#include "zip.h"

/* What all parts of a whole have in common. */
typedef struct part_whole {
    voxels cells;                 /* the grid and the shift alone */
    bool has_ids;                 /* of its cells */
    bool has_labels, has_colours; /* of which only a file of the whole has one, in place of ids */
    uint64_t triangles;
    mesh_sums sums;
    uint64_t position_bytes; /* 4: the mesh is one of floats, 8: of doubles */
    uint64_t accuracy, axes; /* as in tribox_options */
    uint64_t tile;           /* cells along a side of a tile */
} part_whole;

/* Which part it is. */
typedef struct part_header {
    uint32_t shard, shards; /* 1 .. shards; shard 0: the whole, of which it says no more than the grid and the shift */
    uint64_t from, to;      /* the tiles from .. to - 1 are what it holds */
    part_whole whole;
} part_header;

/*
 * The arrays of its file: those that have a row for each brick, or for each set cell, of ids, inside and colours one at most, and a
 * part has none of these but ids; then a row each of what lies in a part_header, from the shard on in a part alone.
 */
enum { NPZ_BITS, NPZ_AT, NPZ_IDS, NPZ_INSIDE, NPZ_COLOURS, NPZ_ORIGIN };
enum { NPZ_CELL = NPZ_ORIGIN + 1, NPZ_SIZE, NPZ_SHIFT, NPZ_SHARD, NPZ_TILES, NPZ_WHOLE, NPZ_END, NPZ_ROW_MOST = 56 };

typedef struct npz_array {
    npy_array npy;
    unsigned rows; /* 0: as many as bricks or cells */
    size_t place;  /* in a part_header, with the others */
} npz_array;
extern const npz_array npz_arrays[NPZ_END];

/* A brick as a tribox_sink is handed it, in the order of tribox_bricks. */
typedef struct part_brick {
    uint32_t at[3];
    uint32_t cells; /* that are set */
    uint64_t bits[8];
    const uint32_t *ids;    /* of its set cells, in the order of the bits; NULL where they have none */
    const rgb *colours;     /* the same */
    const uint64_t *inside; /* which of the bits are inside; NULL without labels */
} part_brick;

/* A checksum of the nine numbers of a triangle, as doubles; 0 of one that is not finite. */
uint64_t part_triangle_checksum(const double u[9]);

mesh_sums mesh_sums_of(const mesh *m);

/* A part that is there: what its file says but for the bricks. */
typedef struct part {
    const char *path;
    part_header header;
    zip_member arrays[3]; /* bits and places of the bricks, and `more` */
    int more;             /* the array of ids, labels or colours; 0 for none of them */
    uint64_t bricks;
    uint64_t cells; /* that part_read has found */
} part;

/* Reads all of a part but the bricks and checks it. Returns an exit_code. */
int part_open(part *p, const char *path);

/*
 * Sorts the parts by their shards, and refuses them where they are not the parts of one whole, each once; also one that is a whole
 * itself. Returns an exit_code.
 */
int part_join(part *parts, size_t count);

/* Takes a brick, for as long as this takes. Returns an exit_code, which ends the reading. */
typedef int part_taker(void *data, const part_brick *brick);

/* Reads a part to its end, in little memory, and refuses one that is damaged: what was taken until then is void. */
int part_read(part *p, unsigned threads, part_taker *take, void *data);

#endif
