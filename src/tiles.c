/* tiles.c - which triangles are in which tile: the calls. */
#include "tiles.h"

#include <string.h>

#include "blocks.h"
#include "environment.h"
#include "finite.h"
#include "grid_f64.h"
#include "mesh_input.h"

/* The tiles along an axis, 0 of one that has none. */
static size_t tiles_along(uint32_t cells, uint32_t tile) { return tile ? cells / tile + (cells % tile != 0) : 0; }

size_t tribox_tiles(const uint32_t size[3], uint32_t tile)
{
    size_t tiles = 1;
    bool is_too_many = false;
    for (int a = 0; a < 3; a++) {
        const size_t along = tiles_along(size[a], tile);
        if (!along)
            return 0;
        is_too_many |= tiles > SIZE_MAX / along;
        tiles *= along;
    }
    return is_too_many ? SIZE_MAX : tiles;
}

bool tribox_tiling_make(const uint32_t size[3], uint32_t tile, size_t from, size_t to, tribox_tiling *tiling)
{
    const size_t tiles = tribox_tiles(size, tile);
    *tiling = (tribox_tiling){.tile = tile, .from = from, .to = to};
    for (int a = 0; a < 3; a++) {
        tiling->size[a] = size[a];
        tiling->along[a] = tiles_along(size[a], tile);
    }
    return tile && tiles < SIZE_MAX && from <= to && to <= tiles;
}

/* One call. */
typedef struct listing {
    tribox_tiling tiling;
    tribox_plan plan;
    const tribox_soup *soup;
    const tribox_grid *grid;
    tribox_mesh mesh;     /* its strides set; */
    tribox_planes planes; /* both where there is no soup and no grid in float */
    uint32_t triangle;    /* the one that is looked at */
    size_t *starts;
    uint32_t *list; /* NULL to count */
} listing;

/* The lowest cells of tiles lie above the planes between them. */
static double plane_of(const void *about, int a, int64_t tile)
{
    const listing *const l = about;
    const uint64_t cell = (uint64_t)tile * l->tiling.tile, plane = cell < l->tiling.size[a] ? cell : l->tiling.size[a];
    return l->grid ? tribox_grid_plane(l->grid, a, plane) : tribox_plane_at(&l->planes, a, (int64_t)plane);
}

static void put(listing *l, size_t tile)
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
    listing *const l = about;
    put(l, ((size_t)at[2] * l->tiling.along[1] + (size_t)at[1]) * l->tiling.along[0] + (size_t)at[0]);
}

/* Tiles base[a] .. base[a] + tiles[a] - 1 of each axis, and on how many axes there are more, even if some lie outside the grid. */
typedef struct tile_range {
    int64_t base[3], tiles[3];
    int spans;
} tile_range;

/* The layers of tiles of the share: nothing but them is looked at. */
static void start_range(const listing *l, tile_range *range)
{
    const tribox_tiling *const t = &l->tiling;
    const size_t layer = t->along[0] * t->along[1];
    for (int a = 0; a < 2; a++) {
        range->base[a] = 0;
        range->tiles[a] = (int64_t)t->along[a];
    }
    range->base[2] = (int64_t)(t->from / layer);
    range->tiles[2] = (int64_t)((t->to - 1) / layer) + 1 - range->base[2];
    range->spans = 3;
}

/* The tiles that the bounding box touches on axis a. */
static bool cut_range(const listing *l, const double u[9], int a, tile_range *range)
{
    const double *const w = u + 3 * a;
    const double low = w[0] < w[1] ? w[0] : w[1], high = w[0] < w[1] ? w[1] : w[0];
    const double least = low < w[2] ? low : w[2], most = high < w[2] ? w[2] : high;
    const int64_t size = l->tiling.size[a], tile = l->tiling.tile, first = range->base[a], end = first + range->tiles[a];
    const tribox_cells cells = l->grid ? tribox_grid_cells(l->grid, a, 0, size, (float)least, (float)most)
                                       : tribox_planes_cells(&l->planes, a, size, least, most);
    const int64_t from = cells.first < 0 ? 0 : cells.first / tile, last = cells.last < size ? cells.last : size - 1;
    if (cells.first >= size || cells.last < 0 || from >= end || last / tile < first)
        return false;
    range->spans -= cells.first >= 0 && cells.last < size && from == last / tile;
    range->base[a] = from > first ? from : first;
    range->tiles[a] = (last / tile < end ? last / tile + 1 : end) - range->base[a];
    return true;
}

static void put_range(listing *l, const tile_range *range)
{
    int64_t at[3];
    for (at[2] = range->base[2]; at[2] < range->base[2] + range->tiles[2]; at[2]++)
        for (at[1] = range->base[1]; at[1] < range->base[1] + range->tiles[1]; at[1]++)
            for (at[0] = range->base[0]; at[0] < range->base[0] + range->tiles[0]; at[0]++)
                put_at(l, at);
}

/* Where its box spans one tile on two axes, a triangle overlaps every tile that it spans on the third (PROOFS.md 7.4). */
static void list_triangle(listing *l, const double u[9])
{
    tile_range range;
    if (!tribox_are_finite_f64(u, 9))
        return;
    start_range(l, &range);
    for (int a = 0; a < 3; a++)
        if (l->plan.axes & TRIBOX_AXES_BOX && !cut_range(l, u, a, &range))
            return;
    if (range.spans < 2 || l->plan.axes == TRIBOX_AXES_BOX) {
        put_range(l, &range);
    } else {
        const tribox_blocks blocks = {.plan = &l->plan, .plane = plane_of, .lattice = l, .take = put_at, .taker = l};
        tribox_blocks_ask(&blocks, u, range.base, range.tiles);
    }
}

static void list_soup(listing *l)
{
    for (size_t i = 0; i < l->soup->count; i++) {
        double u[9];
        for (int n = 0; n < 9; n++)
            u[n] = tribox_soup_axis(l->soup, n / 3)[n % 3][i];
        l->triangle = (uint32_t)i;
        list_triangle(l, u);
    }
}

static void list_mesh(listing *l)
{
    for (size_t i = 0; i < l->mesh.count; i++) {
        double corner[3][3], u[9];
        tribox_mesh_read_corners(&l->mesh, 3 * i, 3, corner);
        for (int n = 0; n < 9; n++)
            u[n] = corner[n % 3][n / 3];
        l->triangle = (uint32_t)i;
        list_triangle(l, u);
    }
}

static void list_triangles(listing *l)
{
    if (l->tiling.from < l->tiling.to)
        (l->soup ? list_soup : list_mesh)(l);
}

/* Each list is counted in the number after its own; their sums are where lists begin. */
static void count(listing *l)
{
    const size_t tiles = l->tiling.to - l->tiling.from;
    memset(l->starts, 0, (tiles + 1) * sizeof *l->starts);
    list_triangles(l);
    for (size_t t = 0; t < tiles; t++)
        l->starts[t + 1] += l->starts[t];
}

/* Every start becomes its list's end, which is the start of the next. */
static void fill(listing *l)
{
    const size_t tiles = l->tiling.to - l->tiling.from;
    list_triangles(l);
    memmove(l->starts + 1, l->starts, tiles * sizeof *l->starts);
    l->starts[0] = 0;
}

/* FAST does without error bounds, which cost little here. */
static tribox_status make_plan(const tribox_options *options, listing *l)
{
    const tribox_status status = tribox_plan_make(options, &l->plan);
    if (!status && l->plan.accuracy == TRIBOX_FAST)
        l->plan.accuracy = TRIBOX_CONSERVATIVE;
    return status;
}

static tribox_status list_float(const tribox_soup *soup, const tribox_grid *grid, uint32_t tile, size_t from, size_t to,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    listing l = {.soup = soup, .grid = grid, .starts = starts, .list = list};
    if (!grid || !starts || !tribox_soup_is_readable(soup) || !tribox_has_numbers(soup->count))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = make_plan(options, &l);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_grid_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_tiling_make(grid->size, tile, from, to, &l.tiling))
        status = TRIBOX_BAD_ARGUMENT;
    else
        (list ? fill : count)(&l);
    tribox_environment_leave(callers);
    return status;
}

static tribox_status list_double(const tribox_mesh *mesh, const tribox_grid_f64 *grid, uint32_t tile, size_t from, size_t to,
                                 const tribox_options *options, size_t *starts, uint32_t *list)
{
    listing l = {.starts = starts, .list = list};
    if (!grid || !starts || !tribox_mesh_is_readable_f64(mesh) || !tribox_has_numbers(mesh->count))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = make_plan(options, &l);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    l.mesh = tribox_mesh_with_strides(mesh);
    if (!tribox_grid_f64_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_tiling_make(grid->size, tile, from, to, &l.tiling))
        status = TRIBOX_BAD_ARGUMENT;
    else if (!tribox_mesh_is_in_range(&l.mesh, l.plan.kernel, 0, mesh->count))
        status = TRIBOX_BAD_INDEX;
    if (!status) {
        l.planes = tribox_planes_of(grid, NULL);
        (list ? fill : count)(&l);
    }
    tribox_environment_leave(callers);
    return status;
}

tribox_status tribox_tiles_count(const tribox_soup *soup, const tribox_grid *grid, uint32_t tile, size_t from, size_t to,
                                 const tribox_options *options, size_t *starts)
{
    return list_float(soup, grid, tile, from, to, options, starts, NULL);
}

tribox_status tribox_tiles_fill(const tribox_soup *soup, const tribox_grid *grid, uint32_t tile, size_t from, size_t to,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    return list ? list_float(soup, grid, tile, from, to, options, starts, list) : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_tiles_count_f64(const tribox_mesh *mesh, const tribox_grid_f64 *grid, uint32_t tile, size_t from, size_t to,
                                     const tribox_options *options, size_t *starts)
{
    return list_double(mesh, grid, tile, from, to, options, starts, NULL);
}

tribox_status tribox_tiles_fill_f64(const tribox_mesh *mesh, const tribox_grid_f64 *grid, uint32_t tile, size_t from, size_t to,
                                    const tribox_options *options, size_t *starts, uint32_t *list)
{
    return list ? list_double(mesh, grid, tile, from, to, options, starts, list) : TRIBOX_BAD_ARGUMENT;
}
