/* bricks.c - the cells of a grid tile by tile, as bricks: the calls. */
#include <string.h>

#include "base/bits.h"
#include "base/environment.h"
#include "brick_call.h"
#include "grid/grid_cells.h"

enum { SIDE_MAX = 1024, LINE = 64 };

size_t tribox_bricks_bytes(uint32_t side)
{
    const size_t row = tribox_words_of(side) * sizeof(uint64_t), block = sizeof(tribox_listed) + LINE;
    size_t bytes = row;
    for (int a = 1; a < 3; a++) {
        if (side && bytes > SIZE_MAX / side)
            return SIZE_MAX;
        bytes *= side;
    }
    return bytes > SIZE_MAX - block ? SIZE_MAX : bytes + block;
}

size_t tribox_bricks_ids_bytes(uint32_t side)
{
    size_t bytes = sizeof(uint32_t);
    for (int a = 0; a < 3; a++) {
        if (side && bytes > SIZE_MAX / side)
            return SIZE_MAX;
        bytes *= side;
    }
    const size_t others = tribox_bricks_bytes(side), more = (TRIBOX_BRICK_IDS_ROOM + TRIBOX_LANES_MAX) * sizeof(uint32_t) + LINE;
    return others > SIZE_MAX - more || bytes > SIZE_MAX - more - others ? SIZE_MAX : bytes + more + others;
}

size_t tribox_bricks_lists_bytes(uint32_t side, size_t most)
{
    const size_t bytes = side > SIDE_MAX ? SIZE_MAX : tribox_brick_lists_bytes_of(side, most), block = sizeof(tribox_listed) + LINE;
    return bytes > SIZE_MAX - block ? SIZE_MAX : bytes + block;
}

static tribox_status emit_tile(tribox_bricks_call *s, size_t number, const uint32_t *list, size_t count)
{
    if (s->lists.sink.take)
        return tribox_brick_lists_of_tile(s, number, list, count);
    return tribox_bricks_of_tile(s, number, list, count) ? TRIBOX_OK : TRIBOX_STOPPED;
}

static tribox_status emit_tiles(tribox_bricks_call *s)
{
    for (size_t t = 0; t < s->tiling.end - s->tiling.first; t++) {
        const size_t count = s->starts[t + 1] - s->starts[t];
        if (!count) /* there may be no list */
            continue;
        const uint32_t *const list = s->list + s->starts[t];
        if (!tribox_listed_are_there(&s->triangles, s->plan.kernel, list, count))
            return TRIBOX_BAD_VERTEX;
        const tribox_status status = emit_tile(s, s->tiling.first + t, list, count);
        if (status)
            return status;
    }
    return TRIBOX_OK;
}

static bool do_rise(const size_t *starts, size_t count)
{
    bool do_all = true;
    for (size_t t = 0; t < count; t++)
        do_all &= starts[t] <= starts[t + 1];
    return do_all;
}

static bool has_share(tribox_bricks_call *s, const tribox_tiles *tiles)
{
    return tribox_tiling_make(s->grid->size, tiles, &s->tiling) && tiles->side % 8 == 0 && tiles->side <= SIDE_MAX &&
           do_rise(s->starts, tiles->count) && (s->list || s->starts[tiles->count] == s->starts[0]);
}

static tribox_status check_bricks(tribox_bricks_call *s, const tribox_tiles *tiles)
{
    const tribox_environment callers = tribox_environment_enter();
    const bool is_sound = tribox_grid_is_sound(s->grid);
    tribox_environment_leave(callers);
    if (!is_sound)
        return TRIBOX_BAD_GRID;
    if (!has_share(s, tiles))
        return TRIBOX_BAD_ARGUMENT;
    const bool are_listed = s->triangles.mesh.indices; /* of a mesh: only the vertices of those in lists are looked at */
    return are_listed || tribox_triangles_have_vertices(&s->triangles, s->plan.kernel) ? TRIBOX_OK : TRIBOX_BAD_VERTEX;
}

static size_t longest_list(const tribox_bricks_call *s)
{
    size_t longest = 0;
    for (size_t t = 0; t < s->tiling.end - s->tiling.first; t++)
        longest = s->starts[t + 1] - s->starts[t] > longest ? s->starts[t + 1] - s->starts[t] : longest;
    return longest;
}

/* Bits, and ids where they are asked for, begin lines of the cache. */
static void use_scratch(tribox_bricks_call *s, void *scratch)
{
    uint32_t most[3];
    char *const aligned = (char *)scratch + (LINE - (uintptr_t)scratch % LINE) % LINE;
    s->block = (tribox_listed *)(void *)aligned;
    if (s->lists.sink.take) {
        tribox_brick_lists_use(&s->lists, s->tiling.side, longest_list(s), aligned + sizeof *s->block);
        return;
    }
    s->bits = (uint64_t *)(void *)(aligned + sizeof *s->block);
    for (int a = 0; a < 3; a++)
        most[a] = s->tiling.size[a] < s->tiling.side ? s->tiling.size[a] : s->tiling.side;
    const size_t words = tribox_window_words(most);
    memset(s->bits, 0, words * sizeof *s->bits);
    s->ids.of_brick = (uint32_t *)(void *)(s->bits + (words + 7) / 8 * 8);
    s->ids.of_tile = s->ids.of_brick + TRIBOX_BRICK_IDS_ROOM;
}

static tribox_status make_bricks(tribox_bricks_call *s, const tribox_tiles *tiles, const tribox_options *options, void *scratch,
                                 tribox_report *report)
{
    if (!s->grid || !tiles || !s->starts || !scratch || !(s->outlet.sink.take || s->lists.sink.take))
        return TRIBOX_BAD_ARGUMENT;
    tribox_status status = tribox_plan_make(options, &s->plan);
    if (!status)
        status = check_bricks(s, tiles);
    if (status)
        return status;
    use_scratch(s, scratch);
    status = emit_tiles(s);
    s->counts.overlapping = s->outlet.cells;
    if (status == TRIBOX_OK || status == TRIBOX_STOPPED)
        tribox_plan_report(&s->plan, s->counts, report);
    return status;
}

tribox_status tribox_bricks(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles, const size_t *starts,
                            const uint32_t *list, const tribox_options *options, void *scratch, const tribox_sink *sink,
                            tribox_report *report)
{
    tribox_bricks_call s = {.grid = grid, .starts = starts, .list = list};
    if (!sink || !tribox_triangles_of_soup(soup, &s.triangles))
        return TRIBOX_BAD_ARGUMENT;
    s.outlet.sink = *sink;
    return make_bricks(&s, tiles, options, scratch, report);
}

tribox_status tribox_mesh_bricks(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles, const size_t *starts,
                                 const uint32_t *list, const tribox_options *options, void *scratch, const tribox_sink *sink,
                                 tribox_report *report)
{
    tribox_bricks_call s = {.grid = grid, .starts = starts, .list = list};
    if (!sink || !tribox_triangles_of_mesh(mesh, &s.triangles))
        return TRIBOX_BAD_ARGUMENT;
    s.outlet.sink = *sink;
    return make_bricks(&s, tiles, options, scratch, report);
}

/* No triangle has the number UINT32_MAX, which stands for none. */
static tribox_status make_bricks_with_ids(tribox_bricks_call *s, const tribox_tiles *tiles, const tribox_options *options,
                                          void *scratch, const tribox_ids_sink *sink, tribox_report *report)
{
    if (!sink || !sink->take || s->triangles.count > UINT32_MAX)
        return TRIBOX_BAD_ARGUMENT;
    s->ids.sink = *sink;
    s->outlet.sink = (tribox_sink){tribox_brick_ids_take, s};
    return make_bricks(s, tiles, options, scratch, report);
}

tribox_status tribox_bricks_ids(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles, const size_t *starts,
                                const uint32_t *list, const tribox_options *options, void *scratch, const tribox_ids_sink *sink,
                                tribox_report *report)
{
    tribox_bricks_call s = {.grid = grid, .starts = starts, .list = list};
    return tribox_triangles_of_soup(soup, &s.triangles) ? make_bricks_with_ids(&s, tiles, options, scratch, sink, report)
                                                        : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_bricks_ids(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                     const size_t *starts, const uint32_t *list, const tribox_options *options, void *scratch,
                                     const tribox_ids_sink *sink, tribox_report *report)
{
    tribox_bricks_call s = {.grid = grid, .starts = starts, .list = list};
    return tribox_triangles_of_mesh(mesh, &s.triangles) ? make_bricks_with_ids(&s, tiles, options, scratch, sink, report)
                                                        : TRIBOX_BAD_ARGUMENT;
}

/* Numbers have 32 bits. */
static tribox_status make_bricks_with_lists(tribox_bricks_call *s, const tribox_tiles *tiles, const tribox_options *options,
                                            void *scratch, const tribox_lists_sink *sink, tribox_report *report)
{
    if (!sink || !tribox_has_numbers(s->triangles.count))
        return TRIBOX_BAD_ARGUMENT;
    s->lists.sink = *sink;
    return make_bricks(s, tiles, options, scratch, report);
}

tribox_status tribox_bricks_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_tiles *tiles, const size_t *starts,
                                  const uint32_t *list, const tribox_options *options, void *scratch, const tribox_lists_sink *sink,
                                  tribox_report *report)
{
    tribox_bricks_call s = {.grid = grid, .starts = starts, .list = list};
    return tribox_triangles_of_soup(soup, &s.triangles) ? make_bricks_with_lists(&s, tiles, options, scratch, sink, report)
                                                        : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_bricks_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_tiles *tiles,
                                       const size_t *starts, const uint32_t *list, const tribox_options *options, void *scratch,
                                       const tribox_lists_sink *sink, tribox_report *report)
{
    tribox_bricks_call s = {.grid = grid, .starts = starts, .list = list};
    return tribox_triangles_of_mesh(mesh, &s.triangles) ? make_bricks_with_lists(&s, tiles, options, scratch, sink, report)
                                                        : TRIBOX_BAD_ARGUMENT;
}
