/* block_sort.c - asks the library which tiles the triangles of a block are in, and gathers them by tile. */
#include "block_sort.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "voxelize/tile_work.h"

enum { NUMBERS = 9 };

bool block_sort_open(block_sort *b, const pieces *all, const tribox_grid *grid, uint32_t tile, bool has_numbers)
{
    *b = (block_sort){.position_bytes = all->write_bytes, .tile = tile, .has_numbers = has_numbers};
    b->positions = malloc(all->block * pieces_room(all));
    b->share = malloc(all->block * sizeof *b->share);
    b->starts = malloc((tribox_tile_count(grid->size, tile) + 1) * sizeof *b->starts);
    return b->positions && b->share && b->starts;
}

void block_sort_close(block_sort *b)
{
    free(b->positions);
    free(b->starts);
    free(b->list);
    free(b->share);
}

/* The layers of tiles along an axis that bounds may be in, with one to spare on both sides. */
static void find_layers(const tribox_grid *grid, uint32_t side, int a, const tribox_box *bounds, double layer[2])
{
    const double most = ceil((double)grid->size[a] / side) - 1, length = grid->cell[a] * side;
    layer[0] = fmin(fmax(floor((bounds->lo[a] - grid->origin[a]) / length) - 1, 0), most);
    layer[1] = fmin(fmax(floor((bounds->hi[a] - grid->origin[a]) / length) + 1, 0), most);
}

/* The tiles in layers of z that a block may be in: fewer than all are cleared and looked through. */
static tribox_tiles find_tiles(const tribox_grid *grid, uint32_t side, const tribox_box *bounds)
{
    const size_t layer = tribox_tile_count((const uint32_t[3]){grid->size[0], grid->size[1], 1}, side);
    double layers[2];
    find_layers(grid, side, 2, bounds, layers);
    return (tribox_tiles){side, (size_t)layers[0] * layer, (size_t)(layers[1] - layers[0] + 1) * layer};
}

static bool grow_list(block_sort *b, size_t needed)
{
    if (needed <= b->list_room)
        return true;
    free(b->list);
    b->list_room = needed + needed / 8;
    b->list = malloc(b->list_room * sizeof *b->list);
    return b->list;
}

static tribox_status list_tiles(block_sort *b, const tribox_mesh *triangles, const tribox_grid *grid, const tribox_tiles *tiles)
{
    const tribox_options exact = {.accuracy = TRIBOX_EXACT};
    const tribox_status status = tribox_mesh_tile_lists(triangles, grid, tiles, &exact, b->starts, NULL);
    if (status)
        return status;
    if (!grow_list(b, b->starts[tiles->count]))
        return MESSAGE_NO_MEMORY;
    return tribox_mesh_tile_lists(triangles, grid, tiles, &exact, b->starts, b->list);
}

static void triangle_at(const block_sort *b, size_t t, double u[NUMBERS])
{
    const float *const narrow = b->positions;
    const double *const wide = b->positions;
    for (size_t k = 0; k < NUMBERS; k++)
        u[k] = b->position_bytes == sizeof(float) ? (double)narrow[t * NUMBERS + k] : wide[t * NUMBERS + k];
}

static void share_work(const block_sort *b, const tribox_grid *grid, size_t count, size_t places)
{
    memset(b->share, 0, count * sizeof *b->share);
    for (size_t p = 0; p < places; p++)
        b->share[b->list[p]]++;
    for (size_t t = 0; t < count; t++)
        if (b->share[t]) {
            double u[NUMBERS];
            triangle_at(b, t, u);
            b->share[t] = (uint32_t)tile_work_of(grid, b->tile, u, b->share[t]);
        }
}

/* Returns where the next go. */
static unsigned char *gather(const block_sort *b, size_t from, size_t to, unsigned char *at, uint64_t *work)
{
    const size_t bytes = NUMBERS * b->position_bytes;
    const unsigned char *const positions = b->positions;
    *work = 0;
    for (size_t p = from; p < to; p++) {
        const size_t t = b->list[p];
        if (bytes == sizeof(float[NUMBERS])) /* of a length that the compiler knows */
            memcpy(at, positions + t * sizeof(float[NUMBERS]), sizeof(float[NUMBERS]));
        else
            memcpy(at, positions + t * sizeof(double[NUMBERS]), sizeof(double[NUMBERS]));
        *work += b->share[t];
        at += bytes;
    }
    return at;
}

static void set_numbers(const block_sort *b, uint64_t first, size_t places, uint32_t *numbers)
{
    for (size_t p = 0; p < places; p++)
        numbers[p] = (uint32_t)(first + b->list[p]);
}

static tribox_status make_run(block_sort *b, const tribox_tiles *tiles, uint64_t first)
{
    size_t filled = 0, r = 0;
    const size_t places = b->starts[tiles->count];
    for (size_t i = 0; i < tiles->count; i++)
        filled += b->starts[i] < b->starts[i + 1];
    const size_t each = NUMBERS * b->position_bytes, bytes = filled * sizeof(partition_tile) + places * each;
    const size_t all = bytes + (b->has_numbers ? places * sizeof(uint32_t) : 0);
    b->run_bytes = (all + sizeof(uint64_t) - 1) / sizeof(uint64_t) * sizeof(uint64_t); /* runs begin at whole words of a file */
    unsigned char *const room = calloc(b->run_bytes ? b->run_bytes : 1, 1);
    if (!room)
        return MESSAGE_NO_MEMORY;
    partition_tile *const records = (void *)room;
    unsigned char *at = room + filled * sizeof *records;
    b->run = (tile_run){
        .tiles = records, .count = filled, .places = places, .triangles = at, .position_bytes = b->position_bytes, .room = room};
    for (size_t i = 0; i < tiles->count; i++)
        if (b->starts[i] < b->starts[i + 1]) {
            records[r] = (partition_tile){.tile = tiles->first + i, .first = b->starts[i]};
            at = gather(b, b->starts[i], b->starts[i + 1], at, &records[r++].work);
        }
    if (b->has_numbers) {
        uint32_t *const numbers = (void *)(room + bytes);
        set_numbers(b, first, places, numbers);
        b->run.numbers = numbers;
    }
    return TRIBOX_OK;
}

tribox_status block_sort_run(block_sort *b, const tribox_grid *grid, const piece_block *block, const tribox_box *bounds)
{
    const size_t count = block->count;
    const tribox_mesh triangles = {
        .positions = b->positions, .vertices = 3 * count, .count = count, .position_bytes = b->position_bytes};
    const bool is_empty = bounds->lo[0] > bounds->hi[0];
    tribox_tiles tiles = {b->tile, 0, 0};
    if (!is_empty)
        tiles = find_tiles(grid, b->tile, bounds);
    b->starts[0] = 0;
    const tribox_status status = is_empty ? TRIBOX_OK : list_tiles(b, &triangles, grid, &tiles);
    if (status)
        return status;
    share_work(b, grid, count, b->starts[tiles.count]);
    return make_run(b, &tiles, block->number);
}
