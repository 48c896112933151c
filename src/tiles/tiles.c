/* tiles.c - which triangles are in which tile: the calls. */
#include "tile_lists.h"

#include "base/environment.h"
#include "grid/grid_f64.h"
#include "mesh/mesh_input.h"

/* The tiles along an axis, 0 of one that has none. */
static size_t tiles_along(uint32_t cells, uint32_t tile) { return tile ? cells / tile + (cells % tile != 0) : 0; }

static size_t count_tiles(const uint32_t size[3], uint32_t tile)
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

size_t tribox_tiles(const uint32_t size[3], uint32_t tile) { return count_tiles(size, tile); }

bool tribox_tiling_make(const uint32_t size[3], uint32_t tile, size_t from, size_t to, tribox_tiling *tiling)
{
    const size_t tiles = count_tiles(size, tile);
    *tiling = (tribox_tiling){.tile = tile, .tiles = tiles, .from = from, .to = to};
    for (int a = 0; a < 3; a++) {
        tiling->size[a] = size[a];
        tiling->along[a] = tiles_along(size[a], tile);
    }
    return tile && tiles < SIZE_MAX && from <= to && to <= tiles;
}

/* FAST does without error bounds, which cost little here. */
static tribox_status make_plan(const tribox_options *options, tribox_tiles_call *l)
{
    const tribox_status status = tribox_plan_make(options, &l->plan);
    if (!status && l->plan.accuracy == TRIBOX_FAST)
        l->plan.accuracy = TRIBOX_CONSERVATIVE;
    return status;
}

static tribox_status list_float(const tribox_soup *soup, const tribox_grid *grid, uint32_t tile, size_t from, size_t to,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_tiles_call l = {.soup = soup, .grid = grid, .starts = starts, .list = list};
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
        tribox_tiles_list(&l);
    tribox_environment_leave(callers);
    return status;
}

static tribox_status list_double(const tribox_mesh *mesh, const tribox_grid_f64 *grid, uint32_t tile, size_t from, size_t to,
                                 const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_tiles_call l = {.starts = starts, .list = list};
    if (!grid || !starts || !tribox_mesh_take(mesh, &l.mesh) || !tribox_has_numbers(mesh->count))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = make_plan(options, &l);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (!tribox_grid_f64_is_sound(grid))
        status = TRIBOX_BAD_GRID;
    else if (!tribox_tiling_make(grid->size, tile, from, to, &l.tiling))
        status = TRIBOX_BAD_ARGUMENT;
    else if (!tribox_mesh_is_in_range(&l.mesh, l.plan.kernel, 0, mesh->count))
        status = TRIBOX_BAD_VERTEX;
    if (!status) {
        l.planes = tribox_planes_of(grid, NULL);
        tribox_tiles_list(&l);
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
