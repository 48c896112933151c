/* part.h - what one of several runs has voxelized, "shard 2 of 8", as a file that tribox merge reads. */
#ifndef PART_H
#define PART_H

#include <stdbool.h>
#include <stdio.h>

#include "console/progress.h"
#include "read/mesh.h"
#include "voxels.h"

/* What all parts of a whole have in common. */
typedef struct part_whole {
    double origin[3], cell[3]; /* of the grid */
    double shift[3];           /* what was subtracted from the mesh */
    uint32_t size[3];
    uint32_t shards;
    uint32_t accuracy, axes; /* as in tribox_options */
    uint32_t plane_bytes;    /* 4: the grid is a tribox_grid, 8: a tribox_grid_f64 */
    uint32_t position_bytes; /* 4: the mesh is one of floats, 8: of doubles */
    uint64_t triangles;
    uint64_t mesh_checksum; /* of their coordinates */
} part_whole;

/* The first bytes of a part, in the byte order of the machine that wrote it; layers of words follow. See tribox(1), FORMATS. */
typedef struct part_header {
    char magic[16]; /* PART_MAGIC and zeros */
    uint32_t byte_order;
    uint32_t shard; /* 1 .. shards */
    part_whole whole;
    uint64_t checksum; /* of all that stands before it and of the words after it */
} part_header;

#define PART_MAGIC "tribox part 3\n"
enum { PART_BYTE_ORDER = 0x01020304 };

/* Takes grid and shift from the voxels, and gives them back. */
void part_set_grid(part_whole *whole, const voxels *v);
voxels part_voxels(const part_whole *whole);

/* The layers of shard 1 .. shards: whole ones, as equal in number as can be, none where there are more shards than layers. */
void part_layers(const part_whole *whole, uint32_t shard, uint32_t *first, uint32_t *layers);

/* A 64-bit hash of the coordinates, as floats or as doubles. */
uint64_t part_mesh_checksum(const mesh *m);

/* The checksum that a header should have with these words after it. A single changed word always changes it. */
uint64_t part_checksum(const part_header *header, const uint64_t *words, size_t count);

bool part_is_name(const char *path);

/* Writes header and words; the checksum is found here, not taken from the header. */
void part_write(FILE *to, const part_header *header, const uint64_t *bits, progress *bar);

/* A part in memory that the system reads from the file as it is needed. */
typedef struct part {
    const char *path;
    part_header header;
    void *mapped;
    size_t size;
} part;

/* Opens a part and checks that it is whole and undamaged. Returns an exit_code; on success part_close gives it back. */
int part_open(part *p, const char *path);
void part_close(part *p);

const uint64_t *part_bits(const part *p);

/* Sorts the parts by their shards and refuses them where they are not the parts of one whole, each once. Returns an exit_code. */
int part_join(part *parts, size_t count);

#endif
