/*
 * fuzz_files.c - the readers of files of the program other than meshes: boxes, parts, partitions, and triangles one after
 * another. The first byte chooses the reader, the others are the file.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "ensure.h"
#include "lines.h"
#include "partition/partition.h"
#include "read/boxes.h"
#include "read/little.h"
#include "read/triangle_file.h"
#include "write/checksum.h"
#include "write/part.h"
#include "write/zip.h"

typedef struct bytes {
    const uint8_t *first;
    size_t size;
} bytes;

static bool is_same_box(const tribox_box *one, const tribox_box *other)
{
    return !memcmp(one->lo, other->lo, sizeof one->lo) && !memcmp(one->hi, other->hi, sizeof one->hi);
}

/* Seventeen digits tell every double. */
static void check_box_again(const tribox_box *box)
{
    char text[200];
    written_box again;
    for (int a = 0; a < 3; a++)
        ensure(isfinite(box->lo[a]) && isfinite(box->hi[a]), "a box that is not finite was read");
    snprintf(text, sizeof text, "%.17g,%.17g %.17g , %.17g\t%.17g,%.17g", box->lo[0], box->lo[1], box->lo[2], box->hi[0],
             box->hi[1], box->hi[2]);
    ensure(box_read(text, "box", &again) && is_same_box(box, &again.bounds), "the box %s is not read as it was written", text);
}

static void read_boxes(bytes b)
{
    FILE *const stream = b.size ? fmemopen((void *)(uintptr_t)b.first, b.size, "r") : NULL;
    box_file boxes = {.file = stream, .name = "boxes"};
    written_box box;
    bool end = !stream;
    int code = EXIT_CODE_OK;
    while (!end && !code) {
        lines_forget();
        code = box_file_next(&boxes, &box, &end);
        lines_fit("box_file_next", code);
        if (!end && !code)
            check_box_again(&box.bounds);
    }
    if (stream)
        box_file_close(&boxes);
}

/* Files, rewritten for each input. */
enum { PARTS = 2, INDEX = PARTS, TRIANGLES, NUMBERS, FILES };

static const char *write_file(int i, bytes b)
{
    static const char *const names[FILES] = {"a.stl", "a.npz", "index", "triangles", "numbers"};
    return lines_file(names[i], b.first, b.size);
}

/* What has been read of a part. */
typedef struct part_bricks {
    const part *p;
    uint64_t bricks, cells;
} part_bricks;

/* Every brick has a place in the grid, and no cell of it is beyond. */
static int take_brick(void *data, const part_brick *brick)
{
    part_bricks *const read = data;
    const uint32_t *const size = read->p->header.whole.cells.grid.size;
    for (int a = 0; a < 3; a++)
        ensure(brick->at[a] <= (size[a] - 1) / 8, "a brick is outside the grid");
    for (uint32_t k = 0; k < 8; k++)
        for (uint32_t b = 0; b < 64; b++) {
            const uint32_t cell[3] = {8 * brick->at[0] + b % 8, 8 * brick->at[1] + b / 8, 8 * brick->at[2] + k};
            const bool is_inside = cell[0] < size[0] && cell[1] < size[1] && cell[2] < size[2];
            ensure(is_inside || !(brick->bits[k] >> b & 1), "a cell is outside the grid");
        }
    ensure(!brick->ids == !read->p->header.whole.has_ids, "ids are there where there are none, or are not");
    read->bricks++;
    read->cells += brick->cells;
    return EXIT_CODE_OK;
}

static void read_part(part *p)
{
    part_bricks read = {.p = p};
    lines_forget();
    const int code = part_read(p, 1, take_brick, &read);
    lines_fit("part_read", code);
    ensure(code || (read.bricks == p->bricks && read.cells == p->cells), "a part is not what it says");
}

/* With the checksums that its bytes ask for, or what stands there would never be looked at. */
static const char *write_part(int i, bytes b)
{
    zip_member members[ZIP_MEMBERS_MAX];
    const char *const name = write_file(i, b);
    FILE *const file = fopen(name, "r+b");
    ensure(file, "cannot open %s", name);
    const unsigned count = zip_in_list(file, b.size, members);
    unsigned listed = 0;
    for (size_t at = 0; at + 20 <= b.size && listed < count; at++)
        if (little_get32(b.first + at) == 0x02014b50) {
            const zip_member *const m = &members[listed++];
            uint8_t crc[4];
            little_put32(crc, zip_crc(0, b.first + m->start, (size_t)m->stored));
            ensure(m->is_deflated || (!fseek(file, (long)at + 16, SEEK_SET) && fwrite(crc, sizeof crc, 1, file)), "cannot write");
        }
    fclose(file);
    return name;
}

/* The first two bytes say how long the first of two parts is. */
static void read_parts(bytes b)
{
    const size_t left = b.size < 2 ? 0 : b.size - 2, said = b.size < 2 ? 0 : b.first[0] + 256u * b.first[1];
    const size_t cut = said < left ? said : left;
    const bytes halves[PARTS] = {{b.first + b.size - left, cut}, {b.first + b.size - left + cut, left - cut}};
    part parts[PARTS];
    int opened = 0;
    for (int code = 0; !code && opened < PARTS && (!opened || halves[opened].size); opened += !code) {
        lines_forget();
        code = part_open(&parts[opened], write_part(opened, halves[opened]));
        lines_fit("part_open", code);
        if (!code)
            read_part(&parts[opened]);
    }
    lines_forget();
    if (opened)
        lines_fit("part_join", part_join(parts, (size_t)opened));
}

/* The triangles of all tiles can be read, whatever they are. */
static void read_tiles(const partition *p)
{
    size_t sound = 0, count = 0;
    for (size_t r = 0; r < p->list.count; r++) {
        sound += partition_is_sound(p->pieces, r);
        count += tile_list_triangles(&p->list, r);
    }
    ensure(sound <= p->list.count && count == p->header.places, "a partition has %zu triangles", count);
}

/* With the checksum that its bytes ask for. Returns how many numbers there are to be. */
static size_t write_index(bytes b)
{
    partition_header header = {.number_bytes = 0};
    uint8_t *const copy = malloc(b.size + 1);
    ensure(copy, "no memory");
    memcpy(copy, b.first, b.size);
    if (b.size >= sizeof header) {
        memcpy(&header, copy, sizeof header);
        header.checksum = checksum_bytes(CHECKSUM_EMPTY, &header, offsetof(partition_header, checksum));
        header.checksum = checksum_bytes(header.checksum, copy + sizeof header, b.size - sizeof header);
        memcpy(copy, &header, sizeof header);
    }
    write_file(INDEX, (bytes){copy, b.size});
    free(copy);
    return header.number_bytes && header.places < 1000 ? (size_t)header.places : 0;
}

/* The first byte is the size of the index, in units of 8 bytes; the triangles follow. All numbers are 0. */
static void read_partition(bytes b)
{
    const size_t cut = b.size && 1 + b.first[0] * 8u < b.size ? 1 + b.first[0] * 8u : b.size;
    partition p;
    static const uint32_t zeros[1000];
    const size_t numbers = write_index((bytes){b.first + (b.size > 0), cut - (b.size > 0)});
    write_file(NUMBERS, (bytes){(const uint8_t *)zeros, numbers * sizeof *zeros});
    write_file(TRIANGLES, (bytes){b.first + cut, b.size - cut});
    const int code = partition_open(&p, &(const char *const){lines_folder()}, 1);
    lines_fit("partition_open", code);
    if (code)
        return;
    read_tiles(&p);
    partition_close(&p);
}

/* How triangles lie in a file of each format. */
static const struct {
    size_t head, record, numbers_at;
} layouts[] = {[TRIANGLES_STL] = {84, 50, 12}, [TRIANGLES_F32] = {0, 36, 0}, [TRIANGLES_F64] = {0, 72, 0}};

/* Of a block: the numbers are those of the file. */
static void check_block(bytes b, const triangle_file *file, float room[9][TRIANGLE_BLOCK], const double *doubles, size_t count)
{
    const bool is_double = file->format == TRIANGLES_F64;
    for (size_t n = 0; n < 9 * count; n++) {
        const size_t i = n / 9, k = n % 9, size = is_double ? 8 : 4;
        const uint8_t *const record =
            b.first + layouts[file->format].head + layouts[file->format].record * (file->taken - count + i);
        const uint8_t *const at = record + layouts[file->format].numbers_at + size * k;
        const uint64_t expected = is_double ? little_get64(at) : little_get32(at);
        uint32_t single;
        uint64_t bits;
        memcpy(&single, &room[k % 3 * 3 + k / 3][i], sizeof single);
        memcpy(&bits, &doubles[n], sizeof bits);
        ensure(expected == (is_double ? bits : single), "number %zu of triangle %zu of a block is another one", k, i);
    }
}

static int read_blocks(bytes b, triangle_file *file)
{
    static float room[9][TRIANGLE_BLOCK];
    static double doubles[9 * TRIANGLE_BLOCK];
    static unsigned char records[TRIANGLE_BLOCK_BYTES];
    float *streams[9];
    triangle_block block = {.bytes = records};
    int code = EXIT_CODE_OK;
    for (int k = 0; k < 9; k++)
        streams[k] = room[k];
    while (!code && !(code = triangle_file_find(file, &block)) && block.count) {
        code = triangle_file_unpack(file, &block, streams, file->format == TRIANGLES_F64 ? doubles : NULL);
        ensure(file->taken <= b.size / layouts[file->format].record, "more triangles than the file has bytes for");
        if (!code)
            check_block(b, file, room, doubles, block.count);
    }
    return code;
}

/* The first byte is the format, and whether the file comes through standard input, which has no size. */
static void read_triangles(bytes b)
{
    const unsigned choice = b.size ? b.first[0] : 0;
    const triangle_format format = (triangle_format)(choice % 4);
    const bytes rest = {b.first + (b.size > 0), b.size - (b.size > 0)};
    const char *path = write_file(0, rest);
    triangle_file file;
    if (choice & 128 && format != TRIANGLES_OTHER) {
        ensure(freopen(path, "rb", stdin), "standard input cannot be %s", path);
        path = "-";
    }
    int code = triangle_file_open(path, format, &file);
    if (!code && file.stream) {
        code = read_blocks(rest, &file);
        ensure(code || layouts[file.format].head + layouts[file.format].record * file.taken == rest.size,
               "%llu triangles are read of %zu bytes", (unsigned long long)file.taken, rest.size);
    }
    lines_fit("triangle_file", code);
    triangle_file_close(&file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static void (*const readers[])(bytes) = {read_boxes, read_parts, read_triangles, read_partition};
    if (!size)
        return 0;
    lines_forget();
    readers[data[0] % (sizeof readers / sizeof readers[0])]((bytes){data + 1, size - 1});
    return 0;
}
