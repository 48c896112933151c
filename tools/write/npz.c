/* npz.c - the table of arrays, and those that are not of bricks. */
#include "npz.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "read/little.h"

const npz_array npz_arrays[NPZ_END] = {
    [NPZ_BITS] = {"bits.npy", "<u8", 8, 64, 0},      [NPZ_AT] = {"at.npy", "<u4", 3, 12, 0},
    [NPZ_IDS] = {"ids.npy", "<u4", 0, 4, 0},         [NPZ_INSIDE] = {"inside.npy", "<u8", 8, 64, 0},
    [NPZ_COLOURS] = {"colours.npy", "|u1", 3, 3, 0}, [NPZ_ORIGIN] = {"origin.npy", "<f8", 0, 8, 3},
    [NPZ_CELL] = {"cell.npy", "<f8", 0, 8, 3},       [NPZ_SIZE] = {"size.npy", "<u4", 0, 4, 3},
    [NPZ_SHIFT] = {"shift.npy", "<f8", 0, 8, 3},     [NPZ_SHARD] = {"shard.npy", "<u4", 0, 4, 2},
    [NPZ_TILES] = {"tiles.npy", "<u8", 0, 8, 2},     [NPZ_WHOLE] = {"whole.npy", "<u8", 0, 8, NPZ_NUMBERS_MOST},
};

void npz_header(unsigned char header[NPY_HEADER], int array, uint64_t rows)
{
    char shape[32];
    const npz_array *const a = &npz_arrays[array];
    if (a->columns)
        snprintf(shape, sizeof shape, "(%" PRIu64 ", %d)", rows, a->columns);
    else
        snprintf(shape, sizeof shape, "(%" PRIu64 ",)", rows);
    npy_header(header, a->type, shape);
}

static void tell_about(npz_about *about, const voxels *v, const part_header *of)
{
    memcpy(about->of[NPZ_ORIGIN], v->grid.origin, sizeof v->grid.origin);
    memcpy(about->of[NPZ_CELL], v->grid.cell, sizeof v->grid.cell);
    memcpy(about->of[NPZ_SHIFT], v->shift, sizeof v->shift);
    for (int a = 0; a < 3; a++)
        about->of[NPZ_SIZE][a] = v->grid.size[a];
    if (!of)
        return;
    const part_whole *const w = &of->whole;
    const uint64_t shard[] = {of->shard, w->shards}, tiles[] = {of->from, of->to};
    const uint64_t whole[] = {w->triangles, w->sums.coordinates, w->sums.order, w->position_bytes, w->accuracy, w->axes, w->tile};
    memcpy(about->of[NPZ_SHARD], shard, sizeof shard);
    memcpy(about->of[NPZ_TILES], tiles, sizeof tiles);
    memcpy(about->of[NPZ_WHOLE], whole, sizeof whole);
}

void npz_add_about(zip_out *zip, const voxels *v, const part_header *of)
{
    npz_about about;
    tell_about(&about, v, of);
    for (int array = NPZ_ORIGIN; array < (of ? NPZ_END : NPZ_SHARD); array++) {
        unsigned char header[NPY_HEADER], bytes[8 * NPZ_NUMBERS_MOST];
        const npz_array *const a = &npz_arrays[array];
        for (unsigned n = 0; n < a->rows; n++)
            if (a->row_bytes == 4)
                little_put32(bytes + 4 * n, (uint32_t)about.of[array][n]);
            else
                little_put64(bytes + 8 * n, about.of[array][n]);
        zip_begin_member(zip, a->name);
        zip_add(zip, bytes, a->rows * (size_t)a->row_bytes);
        npz_header(header, array, a->rows);
        zip_end_member(zip, header);
    }
}

bool npz_take_about(part_header *to, const npz_about *about)
{
    part_whole *const w = &to->whole;
    const uint64_t *const whole = about->of[NPZ_WHOLE];
    memcpy(w->cells.grid.origin, about->of[NPZ_ORIGIN], sizeof w->cells.grid.origin);
    memcpy(w->cells.grid.cell, about->of[NPZ_CELL], sizeof w->cells.grid.cell);
    memcpy(w->cells.shift, about->of[NPZ_SHIFT], sizeof w->cells.shift);
    for (int a = 0; a < 3; a++)
        w->cells.grid.size[a] = (uint32_t)about->of[NPZ_SIZE][a];
    to->shard = (uint32_t)about->of[NPZ_SHARD][0];
    w->shards = (uint32_t)about->of[NPZ_SHARD][1];
    to->from = about->of[NPZ_TILES][0];
    to->to = about->of[NPZ_TILES][1];
    w->triangles = whole[0];
    w->sums = (mesh_sums){whole[1], whole[2]};
    w->position_bytes = (uint32_t)whole[3];
    w->accuracy = (uint32_t)whole[4];
    w->axes = (uint32_t)whole[5];
    w->tile = (uint32_t)whole[6];
    return whole[3] <= UINT32_MAX && whole[4] <= UINT32_MAX && whole[5] <= UINT32_MAX && whole[6] <= UINT32_MAX;
}
