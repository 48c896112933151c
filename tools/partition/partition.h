/*
 * partition.h - a mesh sorted by the tiles of a grid, as a folder of which shards read what is theirs.
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

/* Its files. */
typedef enum partition_file { PARTITION_INDEX, PARTITION_TRIANGLES, PARTITION_NUMBERS, PARTITION_FILES } partition_file;
#define PARTITION_NAMES \
    { \
        "index", "triangles", "numbers" \
    }

/* Records by rising tile, and the triangles of all together. */
typedef struct tile_list {
    partition_tile *tiles;
    size_t count;
    uint64_t places;
} tile_list;

/* Where the triangles of record r begin, which is where those before it end. */
static inline uint64_t tile_list_start(const tile_list *l, size_t r) { return r < l->count ? l->tiles[r].first : l->places; }

/* How many there are. */
static inline size_t tile_list_triangles(const tile_list *l, size_t r)
{
    return (size_t)(tile_list_start(l, r + 1) - tile_list_start(l, r));
}

/* The first record whose tile is not before this one. */
size_t tile_list_find(const tile_list *l, uint64_t tile);

/* Makes places of how many triangles each record has, which `first` is until then. Refuses too many. Returns an exit_code. */
int tile_list_lay(tile_list *l);

/* A folder. */
typedef struct partition_piece {
    const char *path;
    partition_header header;
    tile_list list;
    FILE *files[PARTITION_FILES]; /* no numbers: NULL */
    uint64_t sizes[PARTITION_FILES];
} partition_piece;

/* One, or several of one grid taken as that of all their meshes. */
typedef struct partition {
    partition_header header; /* but for records, places and checksum */
    tile_list list;          /* without checksums */
    partition_piece *pieces;
    size_t count;
} partition;

/* Whether a path is that of a folder, as those of partitions are. */
bool partition_is_folder(const char *path);

/*
 * Opens as many partitions, whose grids, shifts and tiles have to be the same, and checks their indices; triangles are checked tile
 * by tile. Returns an exit_code; on success close it.
 */
int partition_open(partition *p, const char *const *paths, size_t count);
void partition_close(partition *p);

/* Refuses more triangles than ids can number. Returns an exit_code. */
int partition_check_numbers(const char *name, uint64_t triangles);

/* Its grid and shift. */
voxels partition_voxels(const partition_header *header);

/* Whether the triangles of a record, and their numbers, are those that were written. */
bool partition_is_sound(const partition_piece *p, size_t record);

/* Reads the triangles of a record, and their numbers where it has some. False where some are not what was written. */
bool partition_read(const partition *p, size_t record, void *to, uint32_t *numbers);

/* Says which of the pieces has triangles that are not those that were written. Returns EXIT_CODE_FAILURE. */
int partition_refuse_triangles(const partition_piece *pieces, size_t count);

/* Copies triangles, of floats or doubles, as such; floats may become doubles. */
void partition_copy(void *to, unsigned to_bytes, const void *from, unsigned from_bytes, size_t triangles);

#endif
