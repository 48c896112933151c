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
static const char *const file_names[] = PARTITION_NAMES;
static const char no_table[] = "out of memory for the table of tiles";

bool partition_is_folder(const char *path)
{
    file_about about;
    return named_file_about(path, &about) && about.kind == FILE_KIND_FOLDER;
}

voxels partition_voxels(const partition_header *header)
{
    voxels v = {.words = NULL};
    memcpy(v.grid.origin, header->origin, sizeof v.grid.origin);
    memcpy(v.grid.cell, header->cell, sizeof v.grid.cell);
    memcpy(v.grid.size, header->size, sizeof v.grid.size);
    memcpy(v.shift, header->shift, sizeof v.shift);
    return v;
}

static size_t triangle_bytes(const partition_piece *p) { return TRIANGLE_NUMBERS * p->header.position_bytes; }

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

size_t tile_list_find(const tile_list *l, uint64_t tile)
{
    size_t lo = 0, hi = l->count;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (l->tiles[middle].tile < tile)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

int tile_list_lay(tile_list *l)
{
    l->places = 0;
    for (size_t r = 0; r < l->count; r++) {
        const uint64_t triangles = l->tiles[r].first;
        if (triangles > UINT32_MAX)
            return message_failure("a tile has %" PRIu64 " triangles, more than 4294967295; choose smaller cells", triangles);
        l->tiles[r].first = l->places;
        l->places += triangles;
    }
    return EXIT_CODE_OK;
}

/* -------------------------------------------------------------------------------------------------------------------------- one */

static int refuse(const partition_piece *p, const char *why)
{
    return message_failure("%s: damaged: %s; make the partition again", p->path, why);
}

static int open_file(partition_piece *p, partition_file f)
{
    char path[PATH_BYTES];
    file_about about;
    if (snprintf(path, sizeof path, "%s/%s", p->path, file_names[f]) >= PATH_BYTES)
        return message_failure("%s: its name is too long", p->path);
    p->files[f] = named_file_open(path, "rb");
    if (!p->files[f] || !named_file_about_open(p->files[f], &about))
        return message_failure(
            "%s: cannot open %s in it, so that it is no partition: %s; give a mesh, or what tribox partition wrote", p->path,
            file_names[f], strerror(errno));
    p->sizes[f] = about.size;
    return EXIT_CODE_OK;
}

static bool read_at(const partition_piece *p, partition_file f, uint64_t at, void *to, size_t bytes)
{
    size_t got;
    return named_file_read_at(p->files[f], at, to, bytes, &got) && got == bytes;
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

/* Reads the records, too. */
static int read_index(partition_piece *p)
{
    static const char magic[sizeof p->header.magic] = PARTITION_MAGIC, any_version[] = "tribox tiles ";
    const uint64_t size = p->sizes[PARTITION_INDEX];
    if (!read_at(p, PARTITION_INDEX, 0, &p->header, sizeof p->header))
        return refuse(p, "its index has no whole header");
    if (memcmp(p->header.magic, any_version, sizeof any_version - 1))
        return message_failure("%s: not a partition folder; give a mesh, or what tribox partition wrote", p->path);
    if (memcmp(p->header.magic, magic, sizeof magic))
        return refuse(p, "or it is of another version of tribox");
    if (p->header.byte_order != PARTITION_BYTE_ORDER)
        return message_failure("%s: written on a machine of another byte order; make the partition on one like this", p->path);
    const size_t records = (size_t)((size - sizeof p->header) / sizeof(partition_tile)), bytes = records * sizeof(partition_tile);
    if (records != p->header.records || size != sizeof p->header + bytes)
        return refuse(p, "its index has another size than it should");
    p->list = (tile_list){malloc(bytes + 1), records, p->header.places};
    if (!p->list.tiles)
        return message_failure(no_table);
    if (!read_at(p, PARTITION_INDEX, sizeof p->header, p->list.tiles, bytes))
        return refuse(p, "its index cannot be read");
    uint64_t sum = checksum_bytes(CHECKSUM_EMPTY, &p->header, offsetof(partition_header, checksum));
    sum = checksum_bytes(sum, p->list.tiles, bytes);
    if (sum != p->header.checksum)
        return refuse(p, "the checksum of its index does not match");
    return is_header_sound(&p->header) ? EXIT_CODE_OK : refuse(p, "the header of its index makes no sense");
}

static int check_records(const partition_piece *p)
{
    const size_t tiles = tribox_tile_count(p->header.size, p->header.tile);
    uint64_t first = 0, work = 0;
    for (size_t r = 0; r < p->list.count; r++) {
        const partition_tile *const tile = &p->list.tiles[r];
        const uint64_t end = tile_list_start(&p->list, r + 1);
        if (tile->tile >= tiles || (r && tile->tile <= tile[-1].tile) || tile->first != first || end <= first ||
            end - first > UINT32_MAX || tile->work > UINT64_MAX / 2 - work)
            return refuse(p, "the records of its index make no sense");
        first = end;
        work += tile->work;
    }
    const uint64_t triangles = p->sizes[PARTITION_TRIANGLES];
    if (first != p->list.places || first != triangles / triangle_bytes(p) || triangles % triangle_bytes(p))
        return refuse(p, "its triangles are not as many as its index says");
    if (p->header.number_bytes && p->sizes[PARTITION_NUMBERS] != first * sizeof(uint32_t))
        return refuse(p, "its numbers are not as many as its index says");
    return EXIT_CODE_OK;
}

static int open_piece(partition_piece *p, const char *path)
{
    *p = (partition_piece){.path = path};
    int code = open_file(p, PARTITION_INDEX);
    if (!code)
        code = read_index(p);
    if (!code)
        code = open_file(p, PARTITION_TRIANGLES);
    if (!code && p->header.number_bytes)
        code = open_file(p, PARTITION_NUMBERS);
    return code ? code : check_records(p);
}

/* Goes on from a sum. */
static bool add_file(const partition_piece *p, partition_file f, uint64_t at, uint64_t end, uint64_t *sum)
{
    unsigned char bytes[1 << 16];
    uint64_t own = CHECKSUM_EMPTY;
    for (size_t count; at < end; at += count) {
        count = end - at < sizeof bytes ? (size_t)(end - at) : sizeof bytes;
        if (!read_at(p, f, at, bytes, count))
            return false;
        own = checksum_bytes(own, bytes, count);
    }
    *sum += own;
    return true;
}

bool partition_is_sound(const partition_piece *p, size_t record)
{
    const uint64_t first = tile_list_start(&p->list, record), end = tile_list_start(&p->list, record + 1);
    const size_t each = triangle_bytes(p), number = p->header.number_bytes;
    uint64_t sum = 0;
    return add_file(p, PARTITION_TRIANGLES, first * each, end * each, &sum) &&
           (!number || add_file(p, PARTITION_NUMBERS, first * number, end * number, &sum)) && sum == p->list.tiles[record].checksum;
}

/* Floats that are to become doubles are read into the end of their room. */
static bool read_record(const partition_piece *p, size_t r, unsigned bytes, unsigned char *to, uint32_t *numbers)
{
    const size_t count = tile_list_triangles(&p->list, r), own = count * triangle_bytes(p), number = p->header.number_bytes;
    const uint64_t first = p->list.tiles[r].first;
    unsigned char *const end = to + count * TRIANGLE_NUMBERS * bytes - own;
    if (!read_at(p, PARTITION_TRIANGLES, first * triangle_bytes(p), end, own) ||
        (number && !read_at(p, PARTITION_NUMBERS, first * number, numbers, count * number)))
        return false;
    const uint64_t sum = checksum_bytes(CHECKSUM_EMPTY, end, own);
    if (end != to)
        partition_copy(to, bytes, end, p->header.position_bytes, count);
    return sum + (number ? checksum_bytes(CHECKSUM_EMPTY, numbers, count * number) : 0) == p->list.tiles[r].checksum;
}

/* -------------------------------------------------------------------------------------------------------------------------- all */

static int check_pair(const partition_piece *a, const partition_piece *b)
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

/* A checksum is of all that a partition holds, so that a copy has it too. */
static int check_once(const partition_piece *pieces, size_t last)
{
    for (size_t i = 0; i < last; i++)
        if (pieces[i].header.checksum == pieces[last].header.checksum)
            return message_failure("%s and %s are the same partition; give it once", pieces[i].path, pieces[last].path);
    return EXIT_CODE_OK;
}

int partition_check_numbers(const char *name, uint64_t triangles)
{
    return triangles <= INT32_MAX
               ? EXIT_CODE_OK
               : message_failure("%s: %" PRIu64 " triangles are too many for ids, which are int32: leave out --ids", name,
                                 triangles);
}

/* What the headers say of all meshes together; records, places and checksum are left open. */
static int join_headers(partition *p)
{
    partition_header *const all = &p->header;
    *all = p->pieces[0].header;
    for (size_t i = 1; i < p->count; i++) {
        const partition_header *const one = &p->pieces[i].header;
        if (check_pair(&p->pieces[0], &p->pieces[i]) || check_once(p->pieces, i))
            return EXIT_CODE_FAILURE;
        mesh_sums_add(&all->sums, &one->sums, all->triangles);
        all->triangles += one->triangles;
        all->not_finite += one->not_finite;
        all->position_bytes = one->position_bytes > all->position_bytes ? one->position_bytes : all->position_bytes;
    }
    return all->number_bytes ? partition_check_numbers("the partitions", all->triangles) : EXIT_CODE_OK;
}

static int by_tile(const void *a, const void *b)
{
    const uint64_t one = ((const partition_tile *)a)->tile, other = ((const partition_tile *)b)->tile;
    return (one > other) - (one < other);
}

/* Those of one tile become one; `first` is a number of triangles. */
static void merge_records(tile_list *list)
{
    partition_tile *const tiles = list->tiles;
    size_t records = 0;
    qsort(tiles, list->count, sizeof *tiles, by_tile);
    for (size_t i = 0; i < list->count; i++)
        if (records && tiles[records - 1].tile == tiles[i].tile) {
            tiles[records - 1].first += tiles[i].first;
            tiles[records - 1].work += tiles[i].work > TILE_WORK ? tiles[i].work - TILE_WORK : 0;
        } else {
            tiles[records++] = tiles[i];
        }
    list->count = records;
}

static int join_records(partition *p)
{
    size_t count = 0;
    for (size_t i = 0; i < p->count; i++)
        count += p->pieces[i].list.count;
    p->list.tiles = malloc((count + 1) * sizeof *p->list.tiles);
    if (!p->list.tiles)
        return message_failure(no_table);
    for (size_t i = 0; i < p->count; i++)
        for (size_t r = 0; r < p->pieces[i].list.count; r++) {
            partition_tile *const own = &p->list.tiles[p->list.count++];
            *own = p->pieces[i].list.tiles[r];
            own->first = tile_list_triangles(&p->pieces[i].list, r);
        }
    merge_records(&p->list);
    return tile_list_lay(&p->list);
}

int partition_open(partition *p, const char *const *paths, size_t count)
{
    int code = EXIT_CODE_OK;
    *p = (partition){.pieces = calloc(count, sizeof *p->pieces)};
    if (!p->pieces)
        return message_failure("out of memory for %zu partitions", count);
    while (!code && p->count < count) {
        code = open_piece(&p->pieces[p->count], paths[p->count]);
        p->count++;
    }
    if (!code)
        code = join_headers(p);
    if (!code)
        code = join_records(p);
    if (code)
        partition_close(p);
    return code;
}

void partition_close(partition *p)
{
    for (size_t i = 0; i < p->count; i++) {
        for (int f = 0; f < PARTITION_FILES; f++)
            if (p->pieces[i].files[f])
                fclose(p->pieces[i].files[f]);
        free(p->pieces[i].list.tiles);
    }
    free(p->pieces);
    free(p->list.tiles);
}

bool partition_read(const partition *p, size_t record, void *to, uint32_t *numbers)
{
    const unsigned bytes = p->header.position_bytes;
    const uint64_t tile = p->list.tiles[record].tile;
    unsigned char *at = to;
    uint64_t before = 0;
    for (size_t i = 0; i < p->count; before += p->pieces[i++].header.triangles) {
        const partition_piece *const piece = &p->pieces[i];
        const size_t r = tile_list_find(&piece->list, tile);
        if (r == piece->list.count || piece->list.tiles[r].tile != tile)
            continue;
        const size_t count = tile_list_triangles(&piece->list, r);
        if (!read_record(piece, r, bytes, at, numbers))
            return false;
        at += count * TRIANGLE_NUMBERS * bytes;
        for (size_t t = 0; piece->header.number_bytes && t < count; t++)
            *numbers++ += (uint32_t)before; /* they count on from piece to piece */
    }
    return true;
}

static bool is_all_sound(const partition_piece *p)
{
    size_t r = 0;
    while (r < p->list.count && partition_is_sound(p, r))
        r++;
    return r == p->list.count;
}

/* The name of a file that others have cut or continued; else NULL. */
static const char *changed_file(const partition_piece *p)
{
    file_about about;
    for (int f = PARTITION_TRIANGLES; f < PARTITION_FILES; f++)
        if (p->files[f] && named_file_about_open(p->files[f], &about) && about.size != p->sizes[f])
            return file_names[f];
    return NULL;
}

int partition_refuse_triangles(const partition_piece *pieces, size_t count)
{
    size_t i = 0;
    while (i + 1 < count && is_all_sound(&pieces[i]))
        i++;
    const char *const changed = changed_file(&pieces[i]);
    return changed ? message_failure("%s/%s: has changed while it was read; nothing was kept", pieces[i].path, changed)
                   : refuse(&pieces[i], "the checksum of its triangles does not match");
}
