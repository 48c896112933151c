/* partition.c - opens the folder of a partition, and checks that it is whole. */
#include "partition.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "files/named_file.h"

_Static_assert(sizeof(partition_header) == 176 && sizeof(partition_tile) == 32,
               "these are a file format: they have no padding and do not change");

enum { PATH_BYTES = 4096, TRIANGLE_NUMBERS = 9 };

bool partition_is_folder(const char *path)
{
    file_about about;
    return named_file_about(path, &about) && about.kind == FILE_KIND_FOLDER;
}

voxels partition_voxels(const partition_header *header)
{
    voxels v = {.slabs = 0};
    memcpy(v.grid.origin, header->origin, sizeof v.grid.origin);
    memcpy(v.grid.cell, header->cell, sizeof v.grid.cell);
    memcpy(v.grid.size, header->size, sizeof v.grid.size);
    memcpy(v.shift, header->shift, sizeof v.shift);
    return v;
}

static size_t triangle_bytes(const partition *p) { return TRIANGLE_NUMBERS * p->header.position_bytes; }

size_t partition_count(const partition *p, size_t record)
{
    const uint64_t end = record + 1 < p->header.records ? p->tiles[record + 1].first : p->header.places;
    return (size_t)(end - p->tiles[record].first);
}

const void *partition_triangles(const partition *p, size_t record)
{
    return (const unsigned char *)p->triangles.bytes + p->tiles[record].first * triangle_bytes(p);
}

const uint32_t *partition_numbers(const partition *p, size_t record)
{
    return p->header.number_bytes ? (const uint32_t *)p->numbers.bytes + p->tiles[record].first : NULL;
}

bool partition_is_sound(const partition *p, size_t record)
{
    const size_t count = partition_count(p, record);
    const uint32_t *const numbers = partition_numbers(p, record);
    uint64_t sum = checksum_bytes(CHECKSUM_EMPTY, partition_triangles(p, record), count * triangle_bytes(p));
    if (numbers)
        sum += checksum_bytes(CHECKSUM_EMPTY, numbers, count * sizeof *numbers);
    return sum == p->tiles[record].checksum;
}

void partition_copy(void *to, unsigned to_bytes, const void *from, unsigned from_bytes, size_t triangles)
{
    const size_t numbers = TRIANGLE_NUMBERS * triangles;
    if (to_bytes == from_bytes) {
        memcpy(to, from, numbers * to_bytes);
        return;
    }
    for (size_t k = 0; k < numbers; k++) {
        float narrow;
        memcpy(&narrow, (const unsigned char *)from + k * sizeof narrow, sizeof narrow);
        const double wide = (double)narrow;
        memcpy((unsigned char *)to + k * sizeof wide, &wide, sizeof wide);
    }
}

size_t partition_find(const partition_tile *tiles, size_t count, uint64_t tile)
{
    size_t lo = 0, hi = count;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (tiles[middle].tile < tile)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

static int refuse(const partition *p, const char *why)
{
    return message_failure("%s: damaged: %s; make the partition again", p->path, why);
}

static int map_file(const partition *p, const char *name, file_map *map)
{
    char path[PATH_BYTES];
    if (snprintf(path, sizeof path, "%s/%s", p->path, name) >= (int)sizeof path)
        return message_failure("%s: its name is too long", p->path);
    switch (file_map_open(map, path)) {
    case FILE_MAP_OK:
        return EXIT_CODE_OK;
    case FILE_MAP_NOT_OPENED:
        return message_failure(
            "%s: cannot open %s in it, so that it is no partition: %s; give a mesh, or what tribox partition wrote", p->path, name,
            strerror(errno));
    case FILE_MAP_REFUSED:
        break;
    }
    return message_failure("%s: cannot map %s in it", p->path, name);
}

static bool is_size(uint32_t bytes) { return bytes == sizeof(float) || bytes == sizeof(double); }

static bool is_header_sound(const partition_header *header)
{
    enum { TILE_MOST = 1024, BRICK = 8 };
    const voxels v = partition_voxels(header);
    return header->tile && header->tile <= TILE_MOST && header->tile % BRICK == 0 &&
           (!header->number_bytes || (header->number_bytes == sizeof(uint32_t) && header->triangles <= INT32_MAX)) &&
           is_size(header->position_bytes) && header->record_bytes == sizeof(partition_tile) &&
           isfinite(v.shift[0] + v.shift[1] + v.shift[2]) && voxels_are_served(&v.grid, NULL);
}

static int check_header(partition *p)
{
    static const char magic[sizeof p->header.magic] = PARTITION_MAGIC, any_version[] = "tribox tiles ";
    if (p->index.size < sizeof p->header)
        return refuse(p, "its index has no whole header");
    memcpy(&p->header, p->index.bytes, sizeof p->header);
    if (memcmp(p->header.magic, any_version, sizeof any_version - 1))
        return message_failure("%s: not a partition folder; give a mesh, or what tribox partition wrote", p->path);
    if (memcmp(p->header.magic, magic, sizeof magic))
        return refuse(p, "or it is of another version of tribox");
    if (p->header.byte_order != PARTITION_BYTE_ORDER)
        return message_failure("%s: written on a machine of another byte order; make the partition on one like this", p->path);
    const size_t records = (p->index.size - sizeof p->header) / sizeof(partition_tile);
    if (records != p->header.records || p->index.size != sizeof p->header + records * sizeof(partition_tile))
        return refuse(p, "its index has another size than it should");
    p->tiles = (const partition_tile *)((const unsigned char *)p->index.bytes + sizeof p->header);
    uint64_t sum = checksum_bytes(CHECKSUM_EMPTY, &p->header, offsetof(partition_header, checksum));
    sum = checksum_bytes(sum, p->tiles, records * sizeof *p->tiles);
    if (sum != p->header.checksum)
        return refuse(p, "the checksum of its index does not match");
    return is_header_sound(&p->header) ? EXIT_CODE_OK : refuse(p, "the header of its index makes no sense");
}

static int check_records(const partition *p)
{
    const size_t tiles = tribox_tile_count(p->header.size, p->header.tile);
    uint64_t first = 0, work = 0;
    for (size_t r = 0; r < p->header.records; r++) {
        const partition_tile *const tile = &p->tiles[r];
        const uint64_t end = r + 1 < p->header.records ? tile[1].first : p->header.places;
        if (tile->tile >= tiles || (r && tile->tile <= tile[-1].tile) || tile->first != first || end <= first ||
            end - first > UINT32_MAX || tile->work > UINT64_MAX / 2 - work)
            return refuse(p, "the records of its index make no sense");
        first = end;
        work += tile->work;
    }
    if (first != p->header.places || p->header.places != p->triangles.size / triangle_bytes(p) ||
        p->triangles.size % triangle_bytes(p))
        return refuse(p, "its triangles are not as many as its index says");
    if (p->header.number_bytes && p->numbers.size != p->header.places * sizeof(uint32_t))
        return refuse(p, "its numbers are not as many as its index says");
    return EXIT_CODE_OK;
}

int partition_open(partition *p, const char *path)
{
    *p = (partition){.path = path};
    int code = map_file(p, "index", &p->index);
    if (!code)
        code = check_header(p);
    if (!code)
        code = map_file(p, "triangles", &p->triangles);
    if (!code && p->header.number_bytes)
        code = map_file(p, "numbers", &p->numbers);
    if (!code)
        code = check_records(p);
    if (code)
        partition_close(p);
    return code;
}

void partition_close(partition *p)
{
    for (size_t i = 0; i < p->piece_count; i++)
        partition_close(&p->pieces[i]);
    free(p->pieces);
    free(p->own_tiles);
    p->pieces = NULL;
    p->own_tiles = NULL;
    p->piece_count = 0;
    file_map_close(&p->index);
    file_map_close(&p->triangles);
    file_map_close(&p->numbers);
}
