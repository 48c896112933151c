#include "tile_case.h"

#include <math.h>

#include "common/contact.h"
#include "common/harness.h"
#include "voxels/grid_kinds.h"
#include "voxels/grid_scenes_f64.h"
#include "voxels/triangle_kinds.h"

enum { TRIANGLES = 70 };

static float not_a_number(random_source *r) { return random_int(r, 2) ? NAN : random_int(r, 2) ? INFINITY : -INFINITY; }

/* Some corners on a plane between tiles, or next to it. */
static void move_to_tiles(random_source *r, const tile_case *c, float u[3][3])
{
    const int a = random_int(r, 3), tiles = (int)(c->at.grid.size[a] / c->tile) + 1;
    const double place = (double)random_int_between(r, 0, tiles) * c->tile;
    for (int n = random_int_between(r, 1, 3); n > 0; n--)
        u[random_int(r, 3)][a] = nudged(r, grid_planes_place(&c->at.grid, a, place), 1);
}

static void draw_floats(random_source *r, tile_case *c)
{
    const grid_kind *const kind = grid_kind_at((size_t)random_int(r, (int)grid_kind_count()));
    draw_grid_of_kind(r, kind, CASE_CELLS, &c->at);
    c->scene = kind->name;
    c->triangles.count = 0;
    if (random_int(r, 6) == 0)
        draw_mesh(r, &c->at, &c->triangles);
    for (size_t wanted = c->triangles.count + (size_t)random_int(r, TRIANGLES); c->triangles.count < wanted;) {
        float u[3][3];
        draw_triangle(r, triangle_kind_at((size_t)random_int(r, (int)triangle_kind_count())), &c->at, u);
        if (random_int(r, 3) == 0)
            move_to_tiles(r, c, u);
        if (random_int(r, 20) == 0)
            u[random_int(r, 3)][random_int(r, 3)] = not_a_number(r);
        triangle_list_put(&c->triangles, (const_vertices)u);
    }
    for (size_t t = 0; t < c->triangles.count; t++)
        triangle_list_get(&c->triangles, t, c->corners[t]);
}

static void move_to_tiles_f64(random_source *r, const tile_case *c, triangle_f64 u)
{
    const int a = random_int(r, 3), tiles = (int)(c->window.grid.size[a] / c->tile) + 1;
    const double place = window_f64_plane(&c->window.grid, a, (double)random_int_between(r, 0, tiles) * c->tile);
    if (isfinite(place))
        for (int n = random_int_between(r, 1, 3); n > 0; n--)
            u[random_int(r, 3)][a] = random_int(r, 2) ? place : nextafter(place, random_int(r, 2) ? INFINITY : -INFINITY);
}

static void draw_doubles(random_source *r, tile_case *c)
{
    const scene_f64 *const scene = scene_f64_at((size_t)random_int(r, (int)scene_f64_count()));
    window_f64 *const w = &c->window;
    draw_grid_f64(r, scene, random_int(r, 4) ? 1000 : CASE_CELLS_F64, &w->grid);
    window_f64_open(w);
    c->scene = w->scene = scene->name;
    w->count = (size_t)random_int(r, TRIANGLES);
    for (size_t t = 0; t < w->count; t++) {
        draw_triangle_f64(r, &w->grid, w->triangle[t]);
        if (random_int(r, 3) == 0)
            move_to_tiles_f64(r, c, w->triangle[t]);
        if (random_int(r, 20) == 0)
            w->triangle[t][random_int(r, 3)][random_int(r, 3)] = (double)not_a_number(r);
    }
}

/* Of grids of small tiles half have whole tiles alone, and the others are mostly asked by some of the axes. */
static void vary_small_tiles(random_source *r, tile_case *c)
{
    uint32_t *const size = c->is_double ? c->window.grid.size : c->at.grid.size;
    const bool are_small = c->tile <= 4, are_whole = are_small && random_int(r, 2);
    for (int a = 0; a < 3; a++)
        if (are_whole && size[a] > c->tile)
            size[a] -= size[a] % c->tile;
    if (are_small && !are_whole && random_int(r, 4))
        c->options.axes = (unsigned)random_int_between(r, 1, AXIS_SETS);
}

void tile_case_draw(random_source *r, uint32_t tile, tile_case *c)
{
    c->tile = tile ? tile : (uint32_t)random_int_between(r, 1, 40);
    c->is_double = random_int(r, 3) == 0;
    c->is_mesh = c->is_double || random_int(r, 3) == 0;
    if (c->is_double)
        draw_doubles(r, c);
    else
        draw_floats(r, c);
    c->options = (tribox_options){.accuracy = (tribox_accuracy)(random_int(r, 2) ? 0 : random_int(r, 3)),
                                  .axes = (unsigned)(random_int(r, 3) ? 0 : random_int_between(r, 1, AXIS_SETS)),
                                  .kernel = names[random_int(r, kernels)]};
    vary_small_tiles(r, c);
}

void tile_case_tell(const tile_case *c, char *text, size_t length)
{
    const uint32_t *const size = tile_case_size(c);
    snprintf(text, length, "%s of %s, %ux%ux%u cells, tiles of %u, accuracy %d, axes %u, kernel %s", c->scene,
             c->is_double ? "doubles"
             : c->is_mesh ? "a mesh"
                          : "a soup",
             (unsigned)size[0], (unsigned)size[1], (unsigned)size[2], (unsigned)c->tile, (int)c->options.accuracy, c->options.axes,
             c->options.kernel);
}

const uint32_t *tile_case_size(const tile_case *c) { return c->is_double ? c->window.grid.size : c->at.grid.size; }
size_t tile_case_triangles(const tile_case *c) { return c->is_double ? c->window.count : c->triangles.count; }
size_t tile_case_tiles(const tile_case *c) { return tribox_tile_count(tile_case_size(c), c->tile); }

soup_or_mesh tile_case_asked(const tile_case *c)
{
    return (soup_or_mesh){.soup = triangle_list_soup(&c->triangles),
                          .mesh = mesh_of_corners(c->is_double ? (const void *)c->window.triangle : c->corners,
                                                  tile_case_triangles(c), c->is_double ? 8 : 4),
                          .is_mesh = c->is_mesh};
}

soup_or_mesh tile_case_judge(const tile_case *c)
{
    soup_or_mesh of = tile_case_asked(c);
    of.is_mesh = c->is_double;
    return of;
}

const tribox_grid *tile_case_grid(const tile_case *c) { return c->is_double ? &c->window.grid : &c->at.grid; }

tribox_status tile_case_list(const tile_case *c, size_t from, size_t to, size_t *starts, uint32_t *list)
{
    const soup_or_mesh of = tile_case_asked(c);
    const tribox_tiles tiles = {c->tile, from, to - from};
    return CALL(tile_lists, &of, tile_case_grid(c), &tiles, &c->options, starts, list);
}

tribox_status tile_case_part(const tile_case *c, size_t first, size_t count, size_t from, size_t to, size_t *places, uint32_t *list)
{
    const soup_or_mesh of = tile_case_asked(c);
    const tribox_tiles tiles = {c->tile, from, to - from};
    return CALL(tile_lists_part, &of, first, count, tile_case_grid(c), &tiles, &c->options, places, list);
}

tribox_status tile_case_bricks(const tile_case *c, size_t from, size_t to, const size_t *starts, const uint32_t *list,
                               void *scratch, const any_sink *sink, tribox_report *report)
{
    const soup_or_mesh of = tile_case_asked(c);
    const tribox_grid *const grid = tile_case_grid(c);
    const tribox_tiles tiles = {c->tile, from, to - from};
    if (sink->ids.take)
        return CALL(bricks_ids, &of, grid, &tiles, starts, list, &c->options, scratch, &sink->ids, report);
    if (sink->lists.take)
        return CALL(bricks_lists, &of, grid, &tiles, starts, list, &c->options, scratch, &sink->lists, report);
    return CALL(bricks, &of, grid, &tiles, starts, list, &c->options, scratch, &sink->bits, report);
}

size_t tile_case_dense(const tile_case *c, const tribox_options *options, uint64_t *occupied)
{
    const soup_or_mesh of = tile_case_judge(c);
    tribox_report report;
    memset(occupied, 0, CASE_WORDS * sizeof *occupied);
    assert_int_equal(CALL(voxelize, &of, tile_case_grid(c), NULL, options, occupied, &report), TRIBOX_OK);
    return report.overlapping;
}

void tile_case_dense_ids(const tile_case *c, const tribox_options *options, uint64_t *occupied, uint32_t *ids)
{
    const soup_or_mesh of = tile_case_judge(c);
    assert_int_equal(CALL(voxelize_ids, &of, 0, tile_case_grid(c), NULL, options, occupied, ids, NULL), TRIBOX_OK);
}

/* The lowest and the highest planes of a tile's cells. */
static void find_cells(const tile_case *c, size_t tile, uint32_t low[3], uint32_t high[3])
{
    for (int a = 0; a < 3; a++) {
        const uint32_t size = tile_case_size(c)[a], along = (size + c->tile - 1) / c->tile;
        low[a] = (uint32_t)(tile % along) * c->tile;
        high[a] = low[a] + c->tile < size ? low[a] + c->tile : size;
        tile /= along;
    }
}

void tile_case_overlap(const tile_case *c, size_t tile, const tribox_options *options, uint64_t *mask)
{
    const soup_or_mesh of = tile_case_judge(c);
    uint32_t low[3], high[3];
    tribox_box box;
    find_cells(c, tile, low, high);
    for (int a = 0; a < 3; a++) {
        box.lo[a] = window_f64_plane(tile_case_grid(c), a, low[a]);
        box.hi[a] = window_f64_plane(tile_case_grid(c), a, high[a]);
    }
    assert_int_equal(CALL(overlap, &of, &box, options, mask, NULL), TRIBOX_OK);
}

tile_lists tile_case_lists(const tile_case *c, size_t from, size_t to)
{
    tile_lists lists;
    assert_non_null(lists.starts = malloc((to - from + 1) * sizeof *lists.starts));
    assert_int_equal(tile_case_list(c, from, to, lists.starts, NULL), TRIBOX_OK);
    assert_non_null(lists.list = malloc(lists.starts[to - from] * sizeof *lists.list + 1));
    assert_int_equal(tile_case_list(c, from, to, lists.starts, lists.list), TRIBOX_OK);
    return lists;
}

void tile_lists_free(tile_lists lists)
{
    free(lists.starts);
    free(lists.list);
}
