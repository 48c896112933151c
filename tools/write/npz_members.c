/* npz_members.c - writes the grid, and the place of a part, as small arrays. */
#include "npz_members.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "read/little.h"

const npz_array npz_arrays[NPZ_ARRAYS] = {{"bits.npy", "<u8", 8, 64}, {"at.npy", "<u4", 3, 12}, {"ids.npy", "<u4", 0, 4}};

void npz_rows(unsigned char header[NPY_HEADER], const char *type, uint64_t rows, int columns)
{
    char shape[32];
    if (columns)
        snprintf(shape, sizeof shape, "(%" PRIu64 ", %d)", rows, columns);
    else
        snprintf(shape, sizeof shape, "(%" PRIu64 ",)", rows);
    npy_header(header, type, shape);
}

static void add_row(zip_out *zip, const char *name, const char *type, const char *shape, const unsigned char *bytes, size_t size)
{
    unsigned char header[NPY_HEADER];
    zip_begin_member(zip, name);
    zip_add(zip, bytes, size);
    npy_header(header, type, shape);
    zip_end_member(zip, header);
}

static void add_point(zip_out *zip, const char *name, const double point[3])
{
    unsigned char bytes[3 * sizeof(double)];
    for (int a = 0; a < 3; a++) {
        uint64_t bits;
        memcpy(&bits, &point[a], sizeof bits);
        little_put64(bytes + 8 * a, bits);
    }
    add_row(zip, name, "<f8", "(3,)", bytes, sizeof bytes);
}

void npz_add_grid(zip_out *zip, const voxels *v)
{
    unsigned char size[12];
    for (int a = 0; a < 3; a++)
        little_put32(size + 4 * a, v->grid.size[a]);
    add_point(zip, "origin.npy", v->grid.origin);
    add_point(zip, "cell.npy", v->grid.cell);
    add_row(zip, "size.npy", "<u4", "(3,)", size, sizeof size);
    add_point(zip, "shift.npy", v->shift);
}

void npz_add_part(zip_out *zip, const part_header *header)
{
    const part_whole *const whole = &header->whole;
    const uint64_t of[] = {
        whole->triangles, whole->sums.coordinates, whole->sums.order, whole->position_bytes, whole->accuracy, whole->axes,
        whole->tile};
    unsigned char shard[8], tiles[16], bytes[sizeof of];
    little_put32(shard, header->shard);
    little_put32(shard + 4, whole->shards);
    little_put64(tiles, header->from);
    little_put64(tiles + 8, header->to);
    for (size_t n = 0; n < sizeof of / sizeof *of; n++)
        little_put64(bytes + 8 * n, of[n]);
    add_row(zip, "shard.npy", "<u4", "(2,)", shard, sizeof shard);
    add_row(zip, "tiles.npy", "<u8", "(2,)", tiles, sizeof tiles);
    add_row(zip, "whole.npy", "<u8", "(7,)", bytes, sizeof bytes);
}
