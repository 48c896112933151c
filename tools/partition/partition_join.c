/* partition_join.c - several partitions of one grid, made apart, as the partition of all their meshes. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "partition.h"
#include "voxelize/tile_work.h"

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

int partition_check_alike(const partition *pieces, size_t count)
{
    int code = EXIT_CODE_OK;
    for (size_t i = 1; i < count && !code; i++)
        code = check_pair(&pieces[0], &pieces[i]);
    if (!code && pieces[0].header.number_bytes)
        code = partition_check_numbers("the partitions", partition_header_of_all(pieces, count).triangles);
    return code;
}

partition_header partition_header_of_all(const partition *pieces, size_t count)
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
    int code = partition_check_alike(p->pieces, p->piece_count);
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
    p->header = partition_header_of_all(p->pieces, p->piece_count);
    merge_records(p, count);
    for (size_t r = 0; r < p->header.records; r++)
        if ((r + 1 < p->header.records ? p->tiles[r + 1].first : p->header.places) - p->tiles[r].first > UINT32_MAX)
            return message_failure("a tile has more than 4294967295 triangles; choose smaller cells");
    return EXIT_CODE_OK;
}

int partition_open_all(partition *p, const char *const *paths, size_t count)
{
    if (count == 1)
        return partition_open(p, paths[0]);
    int code = EXIT_CODE_OK;
    *p = (partition){.path = paths[0], .pieces = calloc(count, sizeof *p->pieces)};
    if (!p->pieces)
        return message_failure("out of memory for %zu partitions", count);
    while (!code && p->piece_count < count) {
        code = partition_open(&p->pieces[p->piece_count], paths[p->piece_count]);
        p->piece_count += !code;
    }
    if (!code)
        code = join(p);
    if (code)
        partition_close(p);
    return code;
}

bool partition_gather(const partition *p, size_t record, void *to, uint32_t *numbers)
{
    const unsigned bytes = p->header.position_bytes;
    unsigned char *at = to;
    uint64_t before = 0;
    for (size_t i = 0; i < p->piece_count; before += p->pieces[i++].header.triangles) {
        const partition *const piece = &p->pieces[i];
        const size_t records = (size_t)piece->header.records, r = partition_find(piece->tiles, records, p->tiles[record].tile);
        if (r == records || piece->tiles[r].tile != p->tiles[record].tile)
            continue;
        if (!partition_is_sound(piece, r))
            return false;
        const size_t count = partition_count(piece, r);
        const uint32_t *const own = partition_numbers(piece, r);
        partition_copy(at, bytes, partition_triangles(piece, r), piece->header.position_bytes, count);
        at += count * 9 * bytes;
        for (size_t t = 0; numbers && t < count; t++)
            *numbers++ = (uint32_t)(before + own[t]); /* they count on from piece to piece */
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
    while (i < p->piece_count && is_all_sound(&p->pieces[i]))
        i++;
    return message_failure("%s: damaged: the checksum of its triangles does not match; make the partition again",
                           i < p->piece_count ? p->pieces[i].path : p->path);
}
