/* part.h - the bricks that one of several runs has found, "shard 2 of 8", as a file that tribox merge reads. */
#ifndef PART_H
#define PART_H

#include <stdbool.h>
#include <stdio.h>

#include "checksum.h"
#include "read/mesh.h"
#include "voxels.h"

/* What all parts of a whole have in common. */
typedef struct part_whole {
    double origin[3], cell[3]; /* of the grid */
    double shift[3];           /* what was subtracted from the mesh */
    uint32_t size[3];
    uint32_t shards;
    uint32_t accuracy, axes; /* as in tribox_options */
    uint32_t id_bytes;       /* 4: cells have ids; 0: they have none */
    uint32_t position_bytes; /* 4: the mesh is one of floats, 8: of doubles */
    uint32_t tile;           /* cells along a side of a tile */
    uint32_t brick_bytes;    /* of a part_brick */
    uint64_t triangles;
    mesh_sums sums;
} part_whole;

/* The first bytes of a part, in the byte order of the machine that wrote it; bricks and an end follow. See tribox(1), FORMATS. */
typedef struct part_header {
    char magic[16]; /* PART_MAGIC and zeros */
    uint32_t byte_order;
    uint32_t shard; /* 1 .. shards */
    part_whole whole;
    uint64_t from, to; /* the tiles from .. to - 1 are what it holds */
} part_header;

/*
 * A brick as a tribox_sink is handed it, in the order of tribox_bricks; if cells have ids, those of its set cells as uint32 follow.
 */
typedef struct part_brick {
    uint32_t at[3];
    uint32_t cells; /* that are set */
    uint64_t bits[8];
} part_brick;

/* The last bytes. */
typedef struct part_end {
    uint64_t bricks, cells;
    uint64_t checksum; /* of all that stands before it */
} part_end;

#define PART_MAGIC "tribox part 6\n"
enum { PART_BYTE_ORDER = 0x01020304 };

bool part_is_name(const char *path);

/* Takes grid and shift from the voxels, and gives them back. */
void part_set_grid(part_whole *whole, const voxels *v);
voxels part_voxels(const part_whole *whole);

/* A checksum of the nine numbers of a triangle, as doubles; 0 of one that is not finite. */
uint64_t part_triangle_checksum(const double u[9]);

mesh_sums mesh_sums_of(const mesh *m);

/* A part that is being written. */
typedef struct part_writer {
    FILE *to;
    int reason; /* the errno of the first write that failed; 0 so far */
    part_end end;
} part_writer;

part_writer part_start(FILE *to, const part_header *header);
void part_put(part_writer *w, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids);
void part_finish(part_writer *w);

/* A part that is there: what its first and last bytes say. */
typedef struct part {
    const char *path;
    part_header header;
    part_end end;
} part;

/* Reads the first and last bytes of a part and checks them. Returns an exit_code. */
int part_open(part *p, const char *path);

/* Sorts the parts by their shards and refuses them where they are not the parts of one whole, each once. Returns an exit_code. */
int part_join(part *parts, size_t count);

/* Takes a brick and the ids of its set cells; NULL where they have none. Returns an exit_code, which ends the reading. */
typedef int part_take(void *data, const part_brick *brick, const uint32_t *ids);

/* Reads a part to its end, in little memory, and refuses one that is damaged: what was taken until then is void. */
int part_read(const part *p, part_take *take, void *data);

#endif
