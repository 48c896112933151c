/*
 * partition.h - a mesh sorted by the tiles of a grid, as a folder that shards map and read what is theirs of.
 *
 * The folder holds two files, or with numbers three, in the byte order of the machine that wrote them:
 *   index      partition_header, 176 bytes, then a partition_tile, 32 bytes, for every tile that has triangles, by rising tile.
 *   triangles  nine numbers a triangle, x, y and z of its three vertices, floats or doubles as position_bytes says, and nothing
 *              else: the triangles of the first record, those of the second, and so on. A triangle is in the file once for each
 *              tile that it is in. The triangles of a tile are in the order of the mesh.
 *   numbers    if there: for each of these triangles its number in the mesh, from 0, as uint32.
 * A tile has every triangle that touches the box of its cells, as tribox_tile_lists states it, and may have others that come
 * close.
 * Tile (i, j, k) has the number (k * nj + j) * ni + i, where ni and nj are size[0] and size[1] divided by `tile` and rounded up.
 */
#ifndef PARTITION_H
#define PARTITION_H

#include <stdbool.h>

#include "files/files.h"
#include "tribox.h"
#include "write/checksum.h"
#include "write/voxels.h"

/* The first bytes of the index. */
typedef struct partition_header {
    char magic[16];            /*   0: PARTITION_MAGIC and a NUL byte */
    uint32_t byte_order;       /*  16: PARTITION_BYTE_ORDER */
    uint32_t tile;             /*  20: cells along a side of a tile, a multiple of 8 */
    double origin[3], cell[3]; /*  24, 48: of the grid */
    double shift[3];           /*  72: what was subtracted from the mesh; zeros for nothing */
    uint32_t size[3];          /*  96: cells of the grid */
    uint32_t number_bytes;     /* 108: 4: there is the file of numbers; 0: there is none */
    uint32_t position_bytes;   /* 112: 4: the triangles are of floats, 8: of doubles */
    uint32_t record_bytes;     /* 116: of a partition_tile */
    uint64_t triangles;        /* 120: of the mesh */
    mesh_sums sums;            /* 128: of them, which the parts of one whole have in common */
    uint64_t not_finite;       /* 144: how many of them have a NaN or infinite coordinate */
    uint64_t records;          /* 152: tiles that have triangles */
    uint64_t places;           /* 160: triangles of all tiles together: what is in the file */
    uint64_t checksum;         /* 168: of the 168 bytes before it and of the records after it: checksum.h */
} partition_header;

/* A tile. Its triangles end where those of the next record begin, or at places. */
typedef struct partition_tile {
    uint64_t tile;     /*  0: its number */
    uint64_t first;    /*  8: the place of its first triangle in the file */
    uint64_t work;     /* 16: about how many nanoseconds it takes: what shards share evenly: tile_set_shard */
    uint64_t checksum; /* 24: of its triangles' bytes, plus that of its numbers' bytes if there are some */
} partition_tile;

#define PARTITION_MAGIC "tribox tiles 3\n"
enum { PARTITION_BYTE_ORDER = 0x01020304 };

/* One that is open, its files mapped or read; or several of one grid, taken as that of all their meshes. */
typedef struct partition {
    const char *path; /* of the folder, or of the first */
    partition_header header;
    const partition_tile *tiles; /* header.records of them */
    file_map index, triangles, numbers;
    FILE *streams[2];         /* of triangles and of numbers where these are read: their maps have a size alone */
    struct partition *pieces; /* NULL for one, whose files these are */
    size_t piece_count;
    partition_tile *own_tiles; /* of several, without checksums */
} partition;

/* Whether a path is that of a folder, as those of partitions are. */
bool partition_is_folder(const char *path);

/* Opens a partition and checks its index; triangles are checked tile by tile. Returns an exit_code; on success close it. */
int partition_open(partition *p, const char *path);
void partition_close(partition *p);

/*
 * Opens several as one: their grids, shifts and tiles have to be the same. memory: 0, or bytes of which one may map half; triangles
 * of a larger one are left to partition_gather. Returns an exit_code; on success close it.
 */
int partition_open_all(partition *p, const char *const *paths, size_t count, uint64_t memory);

/* Whether the triangles of a record, and their numbers, lie where partition_triangles tells; else they are to be gathered. */
bool partition_is_at_hand(const partition *p);

/* Refuses more triangles than ids can number. Returns an exit_code. */
int partition_check_numbers(const char *name, uint64_t triangles);

/* Its grid and shift. */
voxels partition_voxels(const partition_header *header);

/* How many triangles record `record` has, and, of one partition, where they are. */
size_t partition_count(const partition *p, size_t record);
const void *partition_triangles(const partition *p, size_t record);
const uint32_t *partition_numbers(const partition *p, size_t record); /* NULL where it has none */

/* Whether they are those that were written. */
bool partition_is_sound(const partition *p, size_t record);

/* Copies the triangles of a record, and their numbers where it has some. False where some are not what was written. */
bool partition_gather(const partition *p, size_t record, void *to, uint32_t *numbers);

/* Says which partition, or which of several, has triangles that are not those that were written. Returns EXIT_CODE_FAILURE. */
int partition_refuse_triangles(const partition *p);

/* Copies triangles, of floats or doubles, as such; floats may become doubles. */
void partition_copy(void *to, unsigned to_bytes, const void *from, unsigned from_bytes, size_t triangles);

/* The first of so many rising records whose tile is not before this one. */
size_t partition_find(const partition_tile *tiles, size_t count, uint64_t tile);

#endif
