/* tile_put.c - into which tiles of a share a triangle is put: those that its bounding box touches, asked by blocks. */
#include "tile_lists.h"

#include "base/finite.h"
#include "grid/blocks.h"

double tribox_tile_plane(const void *call, int a, int64_t tile)
{
    const tribox_tiles_call *const l = call;
    const uint64_t cell = (uint64_t)tile * l->tiling.side, plane = cell < l->tiling.size[a] ? cell : l->tiling.size[a];
    return tribox_plane_at(&l->planes, a, (int64_t)plane);
}

static void put_at(void *about, const int64_t at[3])
{
    tribox_tiles_call *const l = about;
    tribox_tiles_put(l, ((size_t)at[2] * l->tiling.along[1] + (size_t)at[1]) * l->tiling.along[0] + (size_t)at[0]);
}

tribox_tile_box tribox_tiling_part(const tribox_tiling *t, size_t at)
{
    const size_t row = t->along[0], rows = t->along[1], layer = row * rows, left = t->end - at;
    const size_t first[3] = {at % row, at / row % rows, at / layer};
    size_t tiles[3] = {left < row - first[0] ? left : row - first[0], 1, 1};
    if (at % row == 0 && left >= row)
        tiles[1] = left / row < rows - first[1] ? left / row : rows - first[1];
    if (at % layer == 0 && left >= layer)
        tiles[2] = left / layer;
    tribox_tile_box part;
    for (int a = 0; a < 3; a++) {
        part.base[a] = (int64_t)first[a];
        part.tiles[a] = (int64_t)tiles[a];
    }
    return part;
}

/* The share in as few boxes as it has (PROOFS.md 7.12): no other tile is looked at, however many there are. */
void tribox_tiles_cut_share(tribox_tiles_call *l)
{
    size_t tiles;
    l->parts = 0;
    for (size_t at = l->tiling.first; at < l->tiling.end; at += tiles) {
        const tribox_tile_box part = tribox_tiling_part(&l->tiling, at);
        tiles = (size_t)part.tiles[0] * (size_t)part.tiles[1] * (size_t)part.tiles[2];
        l->part[l->parts++] = part;
    }
}

/* Tiles of the grid, and on how many axes there are several, even outside the grid. */
typedef struct tile_range {
    tribox_tile_box box;
    int spans;
} tile_range;

static tile_range whole_range(const tribox_tiling *t)
{
    return (tile_range){{.tiles = {(int64_t)t->along[0], (int64_t)t->along[1], (int64_t)t->along[2]}}, 3};
}

/* The tiles that the bounding box touches on axis a. */
static bool cut_range(const tribox_tiles_call *l, const double u[9], int a, tile_range *range)
{
    const double *const w = u + 3 * a;
    const double low = w[0] < w[1] ? w[0] : w[1], high = w[0] < w[1] ? w[1] : w[0];
    const double least = low < w[2] ? low : w[2], most = high < w[2] ? w[2] : high;
    const int64_t size = l->tiling.size[a], side = l->tiling.side;
    const tribox_cells cells = tribox_planes_cells(&l->planes, a, size, least, most);
    const int64_t from = cells.first < 0 ? 0 : cells.first / side, to = (cells.last < size ? cells.last : size - 1) / side;
    if (cells.first >= size || cells.last < 0)
        return false;
    range->spans -= cells.first >= 0 && cells.last < size && from == to;
    range->box.base[a] = from;
    range->box.tiles[a] = to - from + 1;
    return true;
}

/* Where its box spans one tile on two axes, a triangle overlaps every tile that it spans on the third (PROOFS.md 7.4). */
static void put_tiles(tribox_tiles_call *l, const double u[9], const tribox_tile_box *box, int spans)
{
    int64_t at[3];
    if (spans >= 2 && l->plan.axes != TRIBOX_AXES_BOX) {
        const tribox_blocks blocks = {.plan = &l->plan, .plane = tribox_tile_plane, .lattice = l, .take = put_at, .taker = l};
        tribox_blocks_ask(&blocks, u, box->base, box->tiles);
        return;
    }
    for (at[2] = box->base[2]; at[2] < box->base[2] + box->tiles[2]; at[2]++)
        for (at[1] = box->base[1]; at[1] < box->base[1] + box->tiles[1]; at[1]++)
            for (at[0] = box->base[0]; at[0] < box->base[0] + box->tiles[0]; at[0]++)
                put_at(l, at);
}

/* The tiles of both boxes, and whether there are any. */
static bool meet(const tribox_tile_box *b, const tribox_tile_box *c, tribox_tile_box *both)
{
    bool is_within = true;
    for (int a = 0; a < 3; a++) {
        const int64_t b_end = b->base[a] + b->tiles[a], c_end = c->base[a] + c->tiles[a];
        both->base[a] = b->base[a] > c->base[a] ? b->base[a] : c->base[a];
        both->tiles[a] = (b_end < c_end ? b_end : c_end) - both->base[a];
        is_within = is_within && both->tiles[a] > 0;
    }
    return is_within;
}

/* What the share has of a range. */
static void put_shared(tribox_tiles_call *l, const double u[9], const tile_range *range)
{
    for (int n = 0; n < l->parts; n++) {
        tribox_tile_box box;
        if (meet(&range->box, &l->part[n], &box))
            put_tiles(l, u, &box, range->spans);
    }
}

void tribox_tiles_put_by_planes(tribox_tiles_call *l)
{
    double u[9];
    tile_range range = whole_range(&l->tiling);
    tribox_triangles_read(l->triangles, l->triangle, 1, u, 1);
    if (!tribox_are_finite_doubles(u, 9))
        return;
    for (int a = 0; a < 3; a++)
        if (l->plan.axes & TRIBOX_AXES_BOX && !cut_range(l, u, a, &range))
            return;
    put_shared(l, u, &range);
}

/* Where a kernel found more than one tile along one axis alone: lists a line of tiles. False if more than one axis has several. */
static bool put_line(tribox_tiles_call *l, size_t first, unsigned more)
{
    size_t step = 1;
    for (int a = 0; a < 3; step *= l->tiling.along[a], a++, more >>= TRIBOX_TILES_BITS) {
        const unsigned others = more & TRIBOX_TILES_MORE;
        if (others && others != more)
            return false;
        for (unsigned n = 0; others && n <= others; n++)
            tribox_tiles_put(l, first + n * step);
    }
    return true;
}

void tribox_tiles_put_range(tribox_tiles_call *l, size_t first, unsigned more)
{
    const size_t *const along = l->tiling.along;
    tile_range range = {
        {.base = {(int64_t)(first % along[0]), (int64_t)(first / along[0] % along[1]), (int64_t)(first / along[0] / along[1])}}, 2};
    double u[9];
    if (put_line(l, first, more))
        return;
    tribox_triangles_read(l->triangles, l->triangle, 1, u, 1);
    for (int a = 0; a < 3; a++)
        range.box.tiles[a] = 1 + (int64_t)(more >> a * TRIBOX_TILES_BITS & TRIBOX_TILES_MORE);
    put_shared(l, u, &range);
}
