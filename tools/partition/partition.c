/* partition.c - opens the folder of a partition, checks that it is whole, and takes several as that of all their meshes. */
#include "partition.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "files/files.h"
#include "voxelize/tile_set.h"

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

bool partition_is_at_hand(const partition *p) { return !p->pieces && !p->streams[0]; }

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

static int name_file(const partition *p, const char *name, char path[PATH_BYTES])
{
    return snprintf(path, PATH_BYTES, "%s/%s", p->path, name) < PATH_BYTES ? EXIT_CODE_OK
                                                                           : message_failure("%s: its name is too long", p->path);
}

static int map_file(const partition *p, const char *name, file_map *map)
{
    char path[PATH_BYTES];
    if (name_file(p, name, path))
        return EXIT_CODE_FAILURE;
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

static int open_file(partition *p, const char *name, bool is_read, file_map *map, FILE **stream)
{
    char path[PATH_BYTES];
    file_about about;
    if (!is_read)
        return map_file(p, name, map);
    if (name_file(p, name, path))
        return EXIT_CODE_FAILURE;
    *stream = named_file_open(path, "rb");
    if (!*stream || !named_file_about_open(*stream, &about))
        return message_failure("%s: cannot open %s in it: %s", p->path, name, strerror(errno));
    map->size = (size_t)about.size;
    return EXIT_CODE_OK;
}

/* Maps take addresses that a limit of the process may deny to what works on them, and pages count as memory of the process. */
static bool is_larger(const partition *p, uint64_t bytes)
{
    return p->header.places > bytes / (triangle_bytes(p) + p->header.number_bytes);
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

static int open_one(partition *p, const char *path, uint64_t memory)
{
    *p = (partition){.path = path};
    int code = map_file(p, "index", &p->index);
    if (!code)
        code = check_header(p);
    const bool is_read = !code && memory && is_larger(p, memory / 2);
    if (!code)
        code = open_file(p, "triangles", is_read, &p->triangles, &p->streams[0]);
    if (!code && p->header.number_bytes)
        code = open_file(p, "numbers", is_read, &p->numbers, &p->streams[1]);
    if (!code)
        code = check_records(p);
    if (code)
        partition_close(p);
    return code;
}

int partition_open(partition *p, const char *path) { return open_one(p, path, 0); }

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
    for (int i = 0; i < 2; i++) {
        if (p->streams[i])
            fclose(p->streams[i]);
        p->streams[i] = NULL;
    }
}

/* ---------------------------------------------------------------------------------------------------------------------- several */

static int check_pair(const partition *a, const partition *b)
{
    const partition_header *const one = &a->header, *const other = &b->header;
    if (one->number_bytes != other->number_bytes)
        return message_failure("%s has the numbers of its triangles and %s has none; make both with --ids, or neither",
                               one->number_bytes ? a->path : b->path, one->number_bytes ? b->path : a->path);
    const voxels cells = partition_voxels(one), others = partition_voxels(other);
    const char *const place = voxels_difference(&cells, &others);
    const char *const differing = place ? place : one->tile != other->tile ? "size of tiles" : NULL;
    return !differing ? EXIT_CODE_OK
                      : message_failure("%s and %s do not fit together: they differ in the %s; make them with the same --origin, "
                                        "--cell, --size and --shift",
                                        a->path, b->path, differing);
}

int partition_check_numbers(const char *name, uint64_t triangles)
{
    return triangles <= INT32_MAX
               ? EXIT_CODE_OK
               : message_failure("%s: %" PRIu64 " triangles are too many for ids, which are int32: leave out --ids", name,
                                 triangles);
}

/* What the headers of pieces say of all their meshes together; records, places and checksum are left open. */
static partition_header header_of_all(const partition *pieces, size_t count)
{
    partition_header all = pieces[0].header;
    for (size_t i = 1; i < count; i++) {
        const partition_header *const one = &pieces[i].header;
        mesh_sums_add(&all.sums, &one->sums, all.triangles);
        all.triangles += one->triangles;
        all.not_finite += one->not_finite;
        all.position_bytes = one->position_bytes > all.position_bytes ? one->position_bytes : all.position_bytes;
    }
    return all;
}

static int check_alike(const partition *pieces, size_t count)
{
    int code = EXIT_CODE_OK;
    for (size_t i = 1; i < count && !code; i++)
        code = check_pair(&pieces[0], &pieces[i]);
    if (!code && pieces[0].header.number_bytes)
        code = partition_check_numbers("the partitions", header_of_all(pieces, count).triangles);
    return code;
}

static int by_tile(const void *a, const void *b)
{
    const uint64_t one = ((const partition_tile *)a)->tile, other = ((const partition_tile *)b)->tile;
    return (one > other) - (one < other);
}

/* Records of all pieces, of which those of one tile become one; `first` is a number of triangles until then. */
static void merge_records(partition *p, size_t count)
{
    partition_tile *const tiles = p->own_tiles;
    size_t records = 0;
    qsort(tiles, count, sizeof *tiles, by_tile);
    for (size_t i = 0; i < count; i++)
        if (records && tiles[records - 1].tile == tiles[i].tile) {
            tiles[records - 1].first += tiles[i].first;
            tiles[records - 1].work += tiles[i].work > TILE_WORK ? tiles[i].work - TILE_WORK : 0;
        } else {
            tiles[records++] = tiles[i];
        }
    p->header.records = records;
    p->header.places = 0;
    for (size_t r = 0; r < records; r++) {
        const uint64_t triangles = tiles[r].first;
        tiles[r].first = p->header.places;
        p->header.places += triangles;
    }
    p->tiles = tiles;
}

static int join(partition *p)
{
    size_t count = 0, at = 0;
    int code = check_alike(p->pieces, p->piece_count);
    if (code)
        return code;
    for (size_t i = 0; i < p->piece_count; i++)
        count += (size_t)p->pieces[i].header.records;
    p->own_tiles = malloc((count ? count : 1) * sizeof *p->own_tiles);
    if (!p->own_tiles)
        return message_failure("out of memory for the table of tiles");
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t r = 0; r < p->pieces[i].header.records; r++) {
            p->own_tiles[at] = p->pieces[i].tiles[r];
            p->own_tiles[at++].first = partition_count(&p->pieces[i], r);
        }
    p->header = header_of_all(p->pieces, p->piece_count);
    merge_records(p, count);
    for (size_t r = 0; r < p->header.records; r++)
        if ((r + 1 < p->header.records ? p->tiles[r + 1].first : p->header.places) - p->tiles[r].first > UINT32_MAX)
            return message_failure("a tile has more than 4294967295 triangles; choose smaller cells");
    return EXIT_CODE_OK;
}

int partition_open_all(partition *p, const char *const *paths, size_t count, uint64_t memory)
{
    if (count == 1)
        return open_one(p, paths[0], memory);
    int code = EXIT_CODE_OK;
    *p = (partition){.path = paths[0], .pieces = calloc(count, sizeof *p->pieces)};
    if (!p->pieces)
        return message_failure("out of memory for %zu partitions", count);
    while (!code && p->piece_count < count) {
        code = open_one(&p->pieces[p->piece_count], paths[p->piece_count], memory);
        p->piece_count += !code;
    }
    if (!code)
        code = join(p);
    if (code)
        partition_close(p);
    return code;
}

static bool read_at(FILE *stream, uint64_t at, size_t bytes, void *to)
{
    size_t got;
    return named_file_read_at(stream, at, to, bytes, &got) && got == bytes;
}

/* Floats that are to become doubles are read into the end of their room. */
static bool read_record(const partition *p, size_t r, unsigned bytes, unsigned char *to, uint32_t *numbers)
{
    const size_t count = partition_count(p, r), own = count * triangle_bytes(p), of_numbers = count * p->header.number_bytes;
    const uint64_t first = p->tiles[r].first;
    unsigned char *const end = to + count * TRIANGLE_NUMBERS * bytes - own;
    if (!read_at(p->streams[0], first * triangle_bytes(p), own, end) ||
        (of_numbers && !read_at(p->streams[1], first * p->header.number_bytes, of_numbers, numbers)))
        return false;
    const uint64_t sum = checksum_bytes(CHECKSUM_EMPTY, end, own);
    if (end != to)
        partition_copy(to, bytes, end, p->header.position_bytes, count);
    return sum + (of_numbers ? checksum_bytes(CHECKSUM_EMPTY, numbers, of_numbers) : 0) == p->tiles[r].checksum;
}

static bool copy_record(const partition *p, size_t r, unsigned bytes, unsigned char *to, uint32_t *numbers)
{
    if (p->streams[0])
        return read_record(p, r, bytes, to, numbers);
    if (!partition_is_sound(p, r))
        return false;
    partition_copy(to, bytes, partition_triangles(p, r), p->header.position_bytes, partition_count(p, r));
    if (p->header.number_bytes)
        memcpy(numbers, partition_numbers(p, r), partition_count(p, r) * sizeof *numbers);
    return true;
}

bool partition_gather(const partition *p, size_t record, void *to, uint32_t *numbers)
{
    const unsigned bytes = p->header.position_bytes;
    unsigned char *at = to;
    uint64_t before = 0;
    if (!p->pieces)
        return copy_record(p, record, bytes, at, numbers);
    for (size_t i = 0; i < p->piece_count; before += p->pieces[i++].header.triangles) {
        const partition *const piece = &p->pieces[i];
        const size_t records = (size_t)piece->header.records, r = partition_find(piece->tiles, records, p->tiles[record].tile);
        if (r == records || piece->tiles[r].tile != p->tiles[record].tile)
            continue;
        const size_t count = partition_count(piece, r);
        if (!copy_record(piece, r, bytes, at, numbers))
            return false;
        at += count * TRIANGLE_NUMBERS * bytes;
        for (size_t t = 0; piece->header.number_bytes && t < count; t++)
            *numbers++ += (uint32_t)before; /* they count on from piece to piece */
    }
    return true;
}

static bool is_all_sound(const partition *p)
{
    size_t r = 0;
    while (r < p->header.records && partition_is_sound(p, r))
        r++;
    return r == p->header.records;
}

int partition_refuse_triangles(const partition *p)
{
    size_t i = 0;
    while (i < p->piece_count && (p->pieces[i].streams[0] || is_all_sound(&p->pieces[i])))
        i++;
    return message_failure("%s: damaged: the checksum of its triangles does not match; make the partition again",
                           i < p->piece_count ? p->pieces[i].path : p->path);
}
