/* tile_lists.c - which triangles are in which tile: by their bounding boxes in float, or by the planes, and pair by pair. */
#include "tile_lists.h"

#include <string.h>

#include "grid/blocks.h"
#include "pairs/partial_packet.h"
#include "base/finite.h"
#include "grid/grid_f64.h"
#include "mesh/mesh_input.h"
#include "mesh/mesh_streams.h"

/* The lowest cells of tiles lie above the planes between them. */
static double tile_plane(const void *about, int a, int64_t tile)
{
    const tribox_tiles_call *const l = about;
    const uint64_t cell = (uint64_t)tile * l->tiling.tile, plane = cell < l->tiling.size[a] ? cell : l->tiling.size[a];
    return l->grid ? tribox_grid_plane(l->grid, a, plane) : tribox_plane_at(&l->planes, a, (int64_t)plane);
}

static inline void put(tribox_tiles_call *l, size_t tile)
{
    if (tile < l->tiling.from || tile >= l->tiling.to)
        return;
    size_t *const start = l->starts + (tile - l->tiling.from);
    if (l->list)
        l->list[(*start)++] = l->triangle;
    else
        start[1]++;
}

static void put_at(void *about, const int64_t at[3])
{
    tribox_tiles_call *const l = about;
    put(l, ((size_t)at[2] * l->tiling.along[1] + (size_t)at[1]) * l->tiling.along[0] + (size_t)at[0]);
}

/* Tiles of the grid, and on how many axes there are several, even outside the grid. */
typedef struct tile_range {
    tribox_tile_box box;
    int spans;
} tile_range;

/* What the share has from tile `at` on: layers, or else rows of one layer, or else tiles of one row. */
static tribox_tile_box part_from(const tribox_tiling *t, size_t at)
{
    const size_t row = t->along[0], rows = t->along[1], layer = row * rows, left = t->to - at;
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
static void cut_share(tribox_tiles_call *l)
{
    size_t tiles;
    l->parts = 0;
    for (size_t at = l->tiling.from; at < l->tiling.to; at += tiles) {
        const tribox_tile_box part = part_from(&l->tiling, at);
        tiles = (size_t)part.tiles[0] * (size_t)part.tiles[1] * (size_t)part.tiles[2];
        l->part[l->parts++] = part;
    }
}

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
    const int64_t size = l->tiling.size[a], tile = l->tiling.tile;
    const tribox_cells cells = l->grid ? tribox_grid_cells(l->grid, a, 0, size, (float)least, (float)most)
                                       : tribox_planes_cells(&l->planes, a, size, least, most);
    const int64_t from = cells.first < 0 ? 0 : cells.first / tile, to = (cells.last < size ? cells.last : size - 1) / tile;
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
        const tribox_blocks blocks = {.plan = &l->plan, .plane = tile_plane, .lattice = l, .take = put_at, .taker = l};
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
static void put_range(tribox_tiles_call *l, const double u[9], const tile_range *range)
{
    for (int n = 0; n < l->parts; n++) {
        tribox_tile_box box;
        if (meet(&range->box, &l->part[n], &box))
            put_tiles(l, u, &box, range->spans);
    }
}

/* Any triangle. */
static void list_by_planes(tribox_tiles_call *l, const double u[9])
{
    tile_range range = whole_range(&l->tiling);
    if (!tribox_are_finite_f64(u, 9))
        return;
    for (int a = 0; a < 3; a++)
        if (l->plan.axes & TRIBOX_AXES_BOX && !cut_range(l, u, a, &range))
            return;
    put_range(l, u, &range);
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
            put(l, first + n * step);
    }
    return true;
}

/* Where it found more along two axes or three. */
static void list_by_range(tribox_tiles_call *l, const double u[9], size_t first, unsigned more)
{
    const size_t *const along = l->tiling.along;
    tile_range range = {
        {.base = {(int64_t)(first % along[0]), (int64_t)(first / along[0] % along[1]), (int64_t)(first / along[0] / along[1])}}, 2};
    for (int a = 0; a < 3; a++)
        range.box.tiles[a] = 1 + (int64_t)(more >> a * TRIBOX_TILES_BITS & TRIBOX_TILES_MORE);
    put_range(l, u, &range);
}

static void read_listed(const tribox_tiles_call *l, double u[9])
{
    double corner[3][3];
    if (!l->soup)
        tribox_mesh_read_corners(&l->mesh, 3 * (size_t)l->triangle, 3, corner);
    for (int n = 0; n < 9; n++)
        u[n] = l->soup ? tribox_soup_axis(l->soup, n / 3)[n % 3][l->triangle] : corner[n % 3][n / 3];
}

static void list_by_one(tribox_tiles_call *l)
{
    const uint64_t count = l->soup ? l->soup->count : l->mesh.count;
    for (uint64_t i = 0; i < count; i++) {
        double u[9];
        l->triangle = (uint32_t)i;
        read_listed(l, u);
        list_by_planes(l, u);
    }
}

/* A triangle whose bounding box touches several tiles, or whose tiles the kernel cannot tell. */
static void put_other(tribox_tiles_call *l, int32_t first, int32_t more)
{
    const bool is_known = more != TRIBOX_TILES_UNKNOWN;
    double u[9];
    if (is_known && put_line(l, (size_t)first, (unsigned)more))
        return;
    read_listed(l, u);
    if (is_known)
        list_by_range(l, u, (size_t)first, (unsigned)more);
    else
        list_by_planes(l, u);
}

/* What a kernel found of triangles `from` on. */
static void put_found(tribox_tiles_call *l, size_t from, size_t count, const tribox_tile_range *found)
{
    for (size_t i = 0; i < count; i++) {
        l->triangle = (uint32_t)(from + i);
        if (found->more[i] == 0)
            put(l, (size_t)found->first[i]);
        else if (found->more[i] != TRIBOX_TILES_NONE)
            put_other(l, found->first[i], found->more[i]);
    }
}

/* The last block has what is left of the one before, so that it fills a packet. */
static void list_soup(tribox_tiles_call *l)
{
    tribox_tile_range found;
    tribox_partial_packet partial;
    const tribox_soup *const soup = tribox_pad_triangles(l->soup, l->plan.kernel, &partial);
    for (size_t at = 0, some; at < l->soup->count; at += some) {
        const size_t left = l->soup->count - at;
        some = left <= TRIBOX_TILES_BLOCK ? left : TRIBOX_TILES_BLOCK - TRIBOX_LANES_MAX;
        l->plan.kernel->cells->find_tiles(soup, &l->lattice, at, some, &found);
        put_found(l, at, some, &found);
    }
}

static void list_mesh(tribox_tiles_call *l)
{
    _Alignas(64) float streams[9][TRIBOX_TILES_BLOCK] = {{0}};
    float *to[9];
    tribox_tile_range found;
    for (int k = 0; k < 9; k++)
        to[k] = streams[k];
    for (size_t at = 0, some; at < l->mesh.count; at += some) {
        const size_t left = l->mesh.count - at;
        some = left < TRIBOX_TILES_BLOCK ? left : TRIBOX_TILES_BLOCK;
        const tribox_soup soup = tribox_soup_of(&streams[0][0], TRIBOX_TILES_BLOCK, some);
        tribox_mesh_write_soup(&l->mesh, l->plan.kernel, l->planes.origin, at, some, to);
        l->plan.kernel->cells->find_tiles(&soup, &l->lattice, 0, some, &found);
        put_found(l, at, some, &found);
    }
}

/* Planes are off by half a spacing: of floats, or of doubles while float has the place from the first plane (PROOFS.md 7.12). */
static double error_of(const tribox_tiles_call *l, int a)
{
    const double lowest = tile_plane(l, a, 0), highest = tile_plane(l, a, (int64_t)l->tiling.along[a]);
    const double farthest = -lowest > highest ? -lowest : highest;
    return l->grid ? 0x1.001p-24 * farthest + 0x1p-149 : 0x1.001p-52 * farthest;
}

/* Whether float tells tiles apart, and can number them. */
static bool make_lattice(tribox_tiles_call *l)
{
    const tribox_tiling *const t = &l->tiling;
    tribox_tile_lattice *const f = &l->lattice;
    bool fits = l->plan.axes & TRIBOX_AXES_BOX && t->tiles <= INT32_MAX;
    for (int a = 0; a < 3; a++) {
        const double cell = l->grid ? (double)l->grid->cell[a] : l->planes.cell[a], per_tile = 1 / cell / t->tile;
        f->origin[a] = l->grid ? l->grid->origin[a] : 0;
        f->per_tile[a] = (float)per_tile;
        f->end[a] = (float)((double)t->size[a] / t->tile);
        f->doubt[a] = (float)(error_of(l, a) * per_tile) * 1.001f + (f->end[a] + 1) * 0x1p-21f;
        f->along[a] = (int32_t)t->along[a];
        fits &= t->along[a] <= 1 << 20 && f->per_tile[a] >= 0x1p-100f && f->per_tile[a] <= 0x1p100f && f->doubt[a] < 0.5f;
    }
    return fits;
}

static void list_triangles(tribox_tiles_call *l)
{
    cut_share(l);
    if (!l->parts)
        return;
    if (!make_lattice(l))
        list_by_one(l);
    else if (l->soup)
        list_soup(l);
    else
        list_mesh(l);
}

/* Each list is counted in the number after its own; their sums are where lists begin. */
static void count_lists(tribox_tiles_call *l)
{
    const size_t tiles = l->tiling.to - l->tiling.from;
    memset(l->starts, 0, (tiles + 1) * sizeof *l->starts);
    list_triangles(l);
    for (size_t t = 0; t < tiles; t++)
        l->starts[t + 1] += l->starts[t];
}

/* Every start becomes its list's end, which is the start of the next. */
static void fill_lists(tribox_tiles_call *l)
{
    const size_t tiles = l->tiling.to - l->tiling.from;
    list_triangles(l);
    memmove(l->starts + 1, l->starts, tiles * sizeof *l->starts);
    l->starts[0] = 0;
}

void tribox_tiles_list(tribox_tiles_call *l)
{
    if (l->list)
        fill_lists(l);
    else
        count_lists(l);
}
