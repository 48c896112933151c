/* tile_lists.c - which triangles are in which tile: the calls. Bounding boxes are told in float where that tells tiles apart. */
#include "tile_lists.h"

#include <string.h>

#include "base/environment.h"
#include "mesh/mesh_input.h"
#include "tribox_threads.h"

/* What a kernel found of triangles `from` on. */
static void put_found(tribox_tiles_call *l, size_t from, size_t count, const tribox_tile_range *found)
{
    for (size_t i = 0; i < count; i++) {
        l->triangle = (uint32_t)(from + i);
        switch (found->more[i]) {
        case 0:
            tribox_tiles_put(l, (size_t)found->first[i]);
            break;
        case TRIBOX_TILES_NONE:
            break;
        case TRIBOX_TILES_UNKNOWN:
            tribox_tiles_put_by_planes(l);
            break;
        default:
            tribox_tiles_put_range(l, (size_t)found->first[i], (unsigned)found->more[i]);
        }
    }
}

static void list_by_float(tribox_tiles_call *l, const tribox_tile_lattice *lattice)
{
    tribox_stream_room room;
    tribox_tile_range found;
    for (size_t at = l->from, some; at < l->to; at += some) {
        const size_t left = l->to - at;
        some = left < TRIBOX_TILES_BLOCK ? left : TRIBOX_TILES_BLOCK;
        const tribox_soup soup = tribox_triangles_stream(l->triangles, l->plan.kernel, l->first_plane, at, some, &room);
        l->plan.kernel->cells->find_tiles(&soup, lattice, &found);
        put_found(l, at, some, &found);
    }
}

static void list_by_planes(tribox_tiles_call *l)
{
    for (uint64_t i = l->from; i < l->to; i++) {
        l->triangle = (uint32_t)i;
        tribox_tiles_put_by_planes(l);
    }
}

static double magnitude_of(double x) { return x < 0 ? -x : x; }

/* Planes are off by half a spacing of doubles (PROOFS.md 7.12). */
static double error_of(const tribox_tiles_call *l, int a)
{
    const double lowest = tribox_tile_plane(l, a, 0), highest = tribox_tile_plane(l, a, (int64_t)l->tiling.along[a]);
    return 0x1.001p-52 * (-lowest > highest ? -lowest : highest);
}

/*
 * About the float nearest to the first plane, or of doubles about the plane itself. Returns whether float tells tiles apart, and
 * can number them.
 */
static bool make_lattice(const tribox_tiles_call *l, tribox_tile_lattice *f)
{
    const tribox_tiling *const t = &l->tiling;
    bool fits = l->plan.axes & TRIBOX_AXES_BOX && t->tiles <= INT32_MAX;
    for (int a = 0; a < 3; a++) {
        const double per_tile = 1 / l->planes.cell[a] / t->side, first = l->first_plane[a];
        f->origin[a] = l->triangles->are_doubles ? 0 : (float)first;
        const double off = l->triangles->are_doubles ? 0 : (f->origin[a] - first) * per_tile;
        f->per_tile[a] = (float)per_tile;
        f->off[a] = (float)off;
        f->end[a] = (float)((double)t->size[a] / t->side);
        f->doubt[a] = (float)(error_of(l, a) * per_tile + 0x1.4p-22 * magnitude_of(off)) * 1.001f + (f->end[a] + 1) * 0x1p-21f;
        f->along[a] = (int32_t)t->along[a];
        fits &= t->along[a] <= 1 << 20 && f->per_tile[a] >= 0x1p-100f && f->per_tile[a] <= 0x1p100f && f->doubt[a] < 0.5f;
    }
    return fits;
}

static void list_triangles(tribox_tiles_call *l)
{
    tribox_tile_lattice lattice;
    tribox_tiles_cut_share(l);
    if (!l->parts)
        return;
    if (make_lattice(l, &lattice))
        list_by_float(l, &lattice);
    else
        list_by_planes(l);
}

static tribox_status check_lists(tribox_tiles_call *l, const tribox_grid *grid, const tribox_window *window,
                                 const tribox_tiles *tiles)
{
    const tribox_triangles *const t = l->triangles;
    if (!tribox_grid_is_sound(grid))
        return TRIBOX_BAD_GRID;
    if (!tribox_grid_has_window(grid, window) || !tribox_tiling_make(window->size, tiles, &l->tiling))
        return TRIBOX_BAD_ARGUMENT;
    return t->is_soup || tribox_mesh_is_in_range(&t->mesh, l->plan.kernel, l->from, l->to - l->from) ? TRIBOX_OK
                                                                                                     : TRIBOX_BAD_VERTEX;
}

static void make_planes(tribox_tiles_call *l, const tribox_grid *grid, const tribox_window *window)
{
    l->planes = tribox_planes_of(grid, window->first);
    for (int a = 0; a < 3; a++)
        l->first_plane[a] = tribox_tile_plane(l, a, 0);
}

/* FAST does without error bounds, which cost little here. */
static tribox_status list_in_window(const tribox_triangles *triangles, size_t first, size_t count, const tribox_grid *grid,
                                    const tribox_window *window, const tribox_tiles *tiles, const tribox_options *options,
                                    size_t *places, uint32_t *list)
{
    tribox_tiles_call l = {.triangles = triangles, .from = first, .to = first + count, .places = places, .list = list};
    if (!places || !tribox_has_numbers(triangles->count) || first > triangles->count || count > triangles->count - first)
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &l.plan);
    if (status)
        return status;
    l.plan.accuracy = l.plan.accuracy == TRIBOX_FAST ? TRIBOX_CONSERVATIVE : l.plan.accuracy;
    const tribox_environment callers = tribox_environment_enter();
    status = check_lists(&l, grid, window, tiles);
    if (!status) {
        make_planes(&l, grid, window);
        if (!list)
            memset(places, 0, tiles->count * sizeof *places);
        list_triangles(&l);
    }
    tribox_environment_leave(callers);
    return status;
}

static tribox_status list_part(const tribox_triangles *triangles, size_t first, size_t count, const tribox_grid *grid,
                               const tribox_tiles *tiles, const tribox_options *options, size_t *places, uint32_t *list)
{
    if (!grid || !tiles)
        return TRIBOX_BAD_ARGUMENT;
    const tribox_window whole = tribox_whole_window(grid);
    return list_in_window(triangles, first, count, grid, &whole, tiles, options, places, list);
}

/* Every start has become its list's end, which is the start of the next. */
static void put_back(size_t *starts, size_t tiles)
{
    memmove(starts + 1, starts, tiles * sizeof *starts);
    starts[0] = 0;
}

tribox_status tribox_tiles_list(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                const tribox_tiles *tiles, const tribox_options *options, size_t *starts, uint32_t *list)
{
    if (!grid || !tiles || !starts)
        return TRIBOX_BAD_ARGUMENT;
    const tribox_window whole = tribox_whole_window(grid);
    tribox_status status = list_in_window(triangles, 0, triangles->count, grid, window ? window : &whole, tiles, options,
                                          list ? starts : starts + 1, list);
    if (!status && list)
        put_back(starts, tiles->count);
    else if (!status && !tribox_sum_counts(starts, tiles->count))
        status = TRIBOX_BAD_GRID;
    return status;
}

static tribox_status list_tiles(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_tiles *tiles,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_status status;
    return tribox_cells_list_tiles(triangles, grid, tiles, options, starts, list, &status)
               ? status
               : tribox_tiles_list(triangles, grid, NULL, tiles, options, starts, list);
}

tribox_status tribox_tile_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? list_tiles(&triangles, grid, tiles, options, starts, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_tile_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                     const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? list_tiles(&triangles, grid, tiles, options, starts, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_tile_lists_part(const tribox_soup *soup, size_t first, size_t count, const tribox_grid *grid,
                                     const tribox_tiles *tiles, const tribox_options *options, size_t *places, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? list_part(&triangles, first, count, grid, tiles, options, places, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_tile_lists_part(const tribox_mesh *mesh, size_t first, size_t count, const tribox_grid *grid,
                                          const tribox_tiles *tiles, const tribox_options *options, size_t *places, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? list_part(&triangles, first, count, grid, tiles, options, places, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}
