#include "tile_case.h"

#include <math.h>

#include "common/contact.h"
#include "common/harness.h"
#include "voxels/kinds.h"

enum { TRIANGLES = 70 };

/* Some corners on a plane between tiles, or next to it. */
static void move_to_tiles(random_source *r, const tile_case *c, double u[3][3])
{
    const int a = random_int(r, 3), tiles = (int)(c->of.grid.size[a] / c->tile) + 1;
    const double place = cells_place(&c->of, a, (double)random_int_between(r, 0, tiles) * c->tile);
    for (int n = random_int_between(r, 1, 3); n > 0; n--)
        u[random_int(r, 3)][a] = !c->of.is_double   ? (double)nudged(r, (float)place, 1)
                                 : random_int(r, 2) ? place
                                                    : nextafter(place, random_int(r, 2) ? INFINITY : -INFINITY);
}

static void draw_triangles(random_source *r, tile_case *c)
{
    if (!c->of.is_double && random_int(r, 6) == 0)
        put_mesh(r, &c->of);
    for (size_t wanted = c->of.count + (size_t)random_int(r, TRIANGLES); c->of.count < wanted;) {
        double u[3][3];
        put_triangles(r, NULL, 1, SIZE_MAX, &c->of);
        memcpy(u, c->of.u[--c->of.count], sizeof u);
        if (random_int(r, 3) == 0)
            move_to_tiles(r, c, u);
        cells_put(&c->of, u);
    }
}

/* Of grids of small tiles half have whole tiles alone, and the others are mostly asked by some of the axes. */
static void vary_small_tiles(random_source *r, tile_case *c)
{
    uint32_t *const size = c->of.grid.size;
    const bool are_small = c->tile <= 4, are_whole = are_small && random_int(r, 2);
    for (int a = 0; a < 3; a++)
        if (are_whole && size[a] > c->tile)
            size[a] -= size[a] % c->tile;
    cells_open(&c->of);
    if (are_small && !are_whole && random_int(r, 4))
        c->of.options.axes = (unsigned)random_int_between(r, 1, AXIS_SETS);
}

void tile_case_draw(random_source *r, uint32_t tile, tile_case *c)
{
    const size_t floats = grid_kind_floats(), doubles = grid_kind_count() - floats;
    const bool is_double = random_int(r, 3) == 0;
    const size_t kind = is_double ? floats + random_below(r, doubles) : random_below(r, floats);
    c->tile = tile ? tile : (uint32_t)random_int_between(r, 1, 40);
    draw_grid_of_kind(r, grid_kind_at(kind), !is_double ? CASE_CELLS : random_int(r, 4) ? 1000 : CASE_CELLS_F64, &c->of);
    draw_triangles(r, c);
    c->of.form = is_double ? DOUBLES : random_int(r, 3) == 0 ? MESH : SOUP;
    c->of.options = (tribox_options){.accuracy = (tribox_accuracy)(random_int(r, 2) ? 0 : random_int(r, 3)),
                                     .axes = (unsigned)(random_int(r, 3) ? 0 : random_int_between(r, 1, AXIS_SETS)),
                                     .kernel = names[random_int(r, kernels)]};
    vary_small_tiles(r, c);
}

void tile_case_tell(const tile_case *c, char *text, size_t length)
{
    const uint32_t *const size = c->of.grid.size;
    const tribox_options *const o = &c->of.options;
    snprintf(text, length, "%s, form %d, %ux%ux%u cells, tiles of %u, accuracy %d, axes %u, kernel %s", c->of.scene,
             (int)c->of.form, (unsigned)size[0], (unsigned)size[1], (unsigned)size[2], (unsigned)c->tile, (int)o->accuracy, o->axes,
             o->kernel);
}

size_t tile_case_tiles(const tile_case *c) { return tribox_tile_count(c->of.grid.size, c->tile); }

/* Of floats always as a soup, which judges the mesh of them. */
static soup_or_mesh judge_of(const tile_case *c)
{
    soup_or_mesh of = cells_all(&c->of);
    of.is_mesh = c->of.is_double;
    return of;
}

tribox_status tile_case_part(const tile_case *c, size_t first, size_t count, size_t from, size_t to, size_t *places, uint32_t *list)
{
    const soup_or_mesh of = cells_all(&c->of);
    const tribox_tiles tiles = {c->tile, from, to - from};
    return CALL(tile_lists_part, &of, first, count, &c->of.grid, &tiles, &c->of.options, places, list);
}

tribox_status tile_case_bricks(const tile_case *c, const soup_or_mesh *of, size_t from, size_t to, const size_t *starts,
                               const uint32_t *list, void *scratch, const any_sink *sink, tribox_report *report)
{
    const tribox_tiles tiles = {c->tile, from, to - from};
    if (sink->ids.take)
        return CALL(bricks_ids, of, &c->of.grid, &tiles, starts, list, &c->of.options, scratch, &sink->ids, report);
    if (sink->lists.take)
        return CALL(bricks_lists, of, &c->of.grid, &tiles, starts, list, &c->of.options, scratch, &sink->lists, report);
    return CALL(bricks, of, &c->of.grid, &tiles, starts, list, &c->of.options, scratch, &sink->bits, report);
}

void tile_case_dense_ids(const tile_case *c, const tribox_options *options, uint64_t *occupied, uint32_t *ids)
{
    const soup_or_mesh of = judge_of(c);
    assert_int_equal(CALL(voxelize_ids, &of, 0, &c->of.grid, NULL, options, occupied, ids, NULL), TRIBOX_OK);
}

void tile_case_overlap(const tile_case *c, size_t tile, const tribox_options *options, uint64_t *mask)
{
    const soup_or_mesh of = judge_of(c);
    const tribox_box box = box_of_tile(&c->of.grid, c->tile, tile);
    assert_int_equal(CALL(overlap, &of, &box, options, mask, NULL), TRIBOX_OK);
}

tile_lists lists_asked(size_t count, list_call *ask, const void *of)
{
    tile_lists l;
    const size_t bytes = (count + 1) * sizeof *l.starts;
    l.starts_pages = guarded_make(bytes);
    l.starts = guarded_tail(l.starts_pages, bytes);
    memset(l.starts, 0xa5, bytes);
    assert_int_equal(ask(of, l.starts, NULL), TRIBOX_OK);
    assert_int_equal(l.starts[0], 0);
    const size_t length = l.starts[count];
    l.list_pages = guarded_make(length * sizeof *l.list);
    l.list = guarded_tail(l.list_pages, length * sizeof *l.list);
    size_t *const counted = malloc(bytes);
    assert_non_null(counted);
    memcpy(counted, l.starts, bytes);
    assert_int_equal(ask(of, l.starts, l.list), TRIBOX_OK);
    assert_memory_equal(l.starts, counted, bytes);
    free(counted);
    return l;
}

typedef struct share {
    const tile_case *c;
    tribox_tiles tiles;
} share;

static tribox_status list_tiles(const void *of, size_t *starts, uint32_t *list)
{
    const share *const s = of;
    const soup_or_mesh triangles = cells_all(&s->c->of);
    return CALL(tile_lists, &triangles, &s->c->of.grid, &s->tiles, &s->c->of.options, starts, list);
}

tile_lists tile_case_lists(const tile_case *c, size_t from, size_t to)
{
    return lists_asked(to - from, list_tiles, &(share){c, {c->tile, from, to - from}});
}

void tile_lists_free(tile_lists lists)
{
    guarded_free(lists.starts_pages);
    guarded_free(lists.list_pages);
}
