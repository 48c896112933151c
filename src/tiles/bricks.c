/* bricks.c - the cells of a grid tile by tile, as bricks: the calls. */
#include <float.h>
#include <string.h>

#include "base/environment.h"
#include "grid/grid_f64.h"
#include "mesh/mesh_input.h"
#include "tiles.h"
#include "voxels/voxelizing.h"

/* Triangles are gathered a block at a time: as nine streams of float, or as doubles in half the number. */
enum {
    TILE_MAX = 1024,
    BLOCK = 1024,
    BLOCK_F64 = BLOCK / 2,
    STREAM = BLOCK + TRIBOX_LANES_MAX,
    GROUP = 4,
    BLOCK_BYTES = STREAM * 9 * sizeof(float),
    LINE = 64
};

/* One call. */
typedef struct call {
    tribox_tiling tiling;
    const tribox_soup *soup; /* and its grid; or */
    const tribox_grid *grid;
    tribox_mesh mesh; /* its strides set; */
    const tribox_grid_f64 *grid_f64;
    tribox_options options; /* of doubles */
    tribox_plan plan;
    const size_t *starts;
    const uint32_t *list;
    uint64_t *bits;
    void *block;
    tribox_outlet outlet;
    tribox_report counts;
} call;

size_t tribox_bricks_bytes(uint32_t tile)
{
    const size_t row = (size_t)tribox_words_of(tile) * sizeof(uint64_t), block = BLOCK_BYTES + LINE;
    size_t bytes = row;
    for (int a = 1; a < 3; a++) {
        if (tile && bytes > SIZE_MAX / tile)
            return SIZE_MAX;
        bytes *= tile;
    }
    return bytes > SIZE_MAX - block ? SIZE_MAX : bytes + block;
}

/* How many of the next FEW triangles of a list follow each other in the soup. */
static size_t successors(const uint32_t list[GROUP])
{
    size_t following = 1;
    bool follows = true;
    for (uint32_t n = 1; n < GROUP; n++) {
        follows &= list[n] == list[0] + n;
        following += follows;
    }
    return following;
}

/*
 * Triangles list[0] .. list[count - 1] as a soup of their own. FEW are copied at a time, as many follow each other: what is not of
 * the list is overwritten by the next. Its streams do not begin at one place of a page each: caches would have them all in few of
 * their sets, and loads wait for stores.
 */
static tribox_soup gather_floats(const call *s, const uint32_t *list, size_t count)
{
    enum { AHEAD = 32 };
    float *const to = s->block;
    const float *stream[9];
    size_t i = 0;
    for (int n = 0; n < 9; n++)
        stream[n] = tribox_soup_axis(s->soup, n / 3)[n % 3];
    for (size_t following; count - i >= GROUP && s->soup->count - list[i] >= GROUP; i += following) {
        const uint32_t later = list[count - i > AHEAD ? i + AHEAD : count - 1];
        for (size_t n = 0; n < 9; n++) {
            tribox_will_read(stream[n] + later);
            memcpy(to + n * STREAM + i, stream[n] + list[i], GROUP * sizeof *to);
        }
        following = successors(list + i);
    }
    for (; i < count; i++)
        for (size_t n = 0; n < 9; n++)
            to[n * STREAM + i] = stream[n][list[i]];
    return tribox_soup_of(to, STREAM, count);
}

static tribox_mesh gather_doubles(const call *s, const uint32_t *list, size_t count)
{
    double(*const to)[3] = s->block;
    for (size_t i = 0; i < count; i++)
        tribox_mesh_read_corners(&s->mesh, 3 * (size_t)list[i], 3, to + 3 * i);
    return (tribox_mesh){.positions = to,
                         .stride = sizeof *to,
                         .vertices = 3 * count,
                         .count = count,
                         .position_bytes = sizeof(double),
                         .axis_stride = sizeof(double)};
}

/* A tile as a window of the grid. */
typedef struct window {
    uint32_t first[3], size[3];
} window;

static window window_of(const tribox_tiling *t, size_t tile)
{
    const size_t at[3] = {tile % t->along[0], tile / t->along[0] % t->along[1], tile / t->along[0] / t->along[1]};
    window w;
    for (int a = 0; a < 3; a++) {
        w.first[a] = (uint32_t)at[a] * t->tile;
        w.size[a] = t->size[a] - w.first[a] < t->tile ? t->size[a] - w.first[a] : t->tile;
    }
    return w;
}

/* Of a block of triangles: whole packets are asked, and what follows the last triangle repeats it. */
static void find_ends_of_block(const call *s, size_t count, tribox_ends *z)
{
    for (size_t n = 6; n < 9; n++) {
        float *const number = (float *)s->block + n * STREAM;
        for (size_t i = count; i < count + TRIBOX_LANES_MAX; i++)
            number[i] = number[count - 1];
        s->plan.kernel->cells->find_ends(number, count, z);
    }
}

/* Leaves the layers that triangles touch, from the first of a brick on: the others are empty. */
static void cut_layers(const call *s, const tribox_ends *z, window *w)
{
    const int64_t size = w->size[2];
    const float least = z->least < -FLT_MAX ? -FLT_MAX : z->least, most = z->most > FLT_MAX ? FLT_MAX : z->most;
    if (!(s->plan.axes & TRIBOX_AXES_BOX))
        return;
    const tribox_cells cells = tribox_grid_cells(s->grid, 2, w->first[2], size, least, most);
    const int64_t from = cells.first < 0 ? 0 : cells.first / 8 * 8, end = cells.last < size ? cells.last + 1 : size;
    w->first[2] += (uint32_t)from;
    w->size[2] = least <= most && from < end ? (uint32_t)(end - from) : 0;
}

static void set_tile(call *s, window *w, const uint32_t *list, size_t count)
{
    tribox_voxels voxels, *const v = &voxels;
    tribox_ends z = {FLT_MAX, -FLT_MAX};
    const tribox_environment callers = tribox_environment_enter();
    v->plan = s->plan;
    tribox_voxels_begin(v, s->grid, w->first, w->size, s->bits);
    for (size_t at = 0; at < count; at += BLOCK) {
        const tribox_soup soup = gather_floats(s, list + at, count - at < BLOCK ? count - at : BLOCK);
        tribox_voxels_put_soup(v, &soup);
        find_ends_of_block(s, soup.count, &z);
    }
    tribox_voxels_end(v);
    s->counts.undecided += v->counts.undecided;
    cut_layers(s, &z, w);
    tribox_environment_leave(callers);
}

static void set_tile_f64(call *s, window *w, const uint32_t *list, size_t count)
{
    tribox_voxels voxels, *const v = &voxels;
    const tribox_environment callers = tribox_environment_enter();
    v->plan = s->plan;
    for (size_t at = 0; at < count; at += BLOCK_F64) {
        const tribox_mesh mesh = gather_doubles(s, list + at, count - at < BLOCK_F64 ? count - at : BLOCK_F64);
        tribox_voxels_set_mesh(v, &mesh, s->grid_f64, w->first, w->size, s->bits);
        s->counts.undecided += v->counts.undecided;
    }
    tribox_environment_leave(callers);
}

static bool are_all_below(const uint32_t *list, size_t count, size_t end)
{
    uint32_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        greatest = list[i] > greatest ? list[i] : greatest;
    return !count || greatest < end;
}

/* Of the triangles of a list alone: a call about few tiles of a large mesh looks at few of its indices. */
static bool have_vertices(const tribox_mesh *mesh, const uint32_t *list, size_t count)
{
    const unsigned bytes = tribox_vertex_bytes(mesh);
    size_t greatest = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t number = tribox_vertex_number(mesh, bytes, 3 * (size_t)list[i] + v);
            greatest = number > greatest ? number : greatest;
        }
    return greatest < mesh->vertices;
}

/* The environment of the sink is the caller's. */
static tribox_status emit_tiles(call *s)
{
    const size_t triangles = s->soup ? s->soup->count : s->mesh.count;
    for (size_t t = 0; t < s->tiling.to - s->tiling.from; t++) {
        const uint32_t *const list = s->list + s->starts[t];
        const size_t count = s->starts[t + 1] - s->starts[t];
        if (!count)
            continue;
        if (!are_all_below(list, count, triangles) || (!s->soup && !have_vertices(&s->mesh, list, count)))
            return TRIBOX_BAD_VERTEX;
        const window all = window_of(&s->tiling, s->tiling.from + t);
        window w = all;
        if (s->soup)
            set_tile(s, &w, list, count);
        else
            set_tile_f64(s, &w, list, count);
        uint64_t *const bits = s->bits + (w.first[2] - all.first[2]) * all.size[1] * tribox_words_of(all.size[0]);
        if (!s->plan.kernel->cells->emit(bits, w.first, w.size, &s->outlet))
            return TRIBOX_STOPPED;
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

/* Scratch, lists and tiles, which both forms have. */
static bool is_share(call *s, const uint32_t size[3], uint32_t tile, size_t from, size_t to, const size_t *starts,
                     const uint32_t *list)
{
    if (!tribox_tiling_make(size, tile, from, to, &s->tiling) || tile % 8 || tile > TILE_MAX || !do_rise(starts, to - from) ||
        (!list && starts[to - from] > starts[0]))
        return false;
    s->starts = starts;
    s->list = list;
    return true;
}

/* Bits are zero again after each tile. */
static void use_scratch(call *s, void *scratch)
{
    uint32_t most[3];
    char *const aligned = (char *)scratch + (LINE - (uintptr_t)scratch % LINE) % LINE;
    s->block = aligned;
    s->bits = (uint64_t *)(void *)(aligned + BLOCK_BYTES);
    for (int a = 0; a < 3; a++)
        most[a] = s->tiling.size[a] < s->tiling.tile ? s->tiling.size[a] : s->tiling.tile;
    memset(s->bits, 0, (size_t)tribox_words_of(most[0]) * most[1] * most[2] * sizeof *s->bits);
}

static tribox_status finish_bricks(call *s, tribox_status status, tribox_report *report)
{
    s->counts.overlapping = s->outlet.cells;
    if (status == TRIBOX_OK || status == TRIBOX_STOPPED)
        tribox_plan_report(&s->plan, s->counts, report);
    return status;
}

tribox_status tribox_voxelize_bricks(const tribox_soup *soup, const tribox_grid *grid, uint32_t tile, size_t from, size_t to,
                                     const size_t *starts, const uint32_t *list, const tribox_options *options, void *scratch,
                                     tribox_sink *sink, void *data, tribox_report *report)
{
    call s = {.soup = soup, .grid = grid, .outlet = {.sink = sink, .data = data}};
    if (!grid || !starts || !scratch || !sink || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = tribox_plan_make(options, &s.plan);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    const bool is_sound = tribox_grid_is_sound(grid);
    tribox_environment_leave(callers);
    if (!is_sound)
        return TRIBOX_BAD_GRID;
    if (!is_share(&s, grid->size, tile, from, to, starts, list))
        return TRIBOX_BAD_ARGUMENT;
    use_scratch(&s, scratch);
    return finish_bricks(&s, emit_tiles(&s), report);
}

tribox_status tribox_voxelize_bricks_f64(const tribox_mesh *mesh, const tribox_grid_f64 *grid, uint32_t tile, size_t from,
                                         size_t to, const size_t *starts, const uint32_t *list, const tribox_options *options,
                                         void *scratch, tribox_sink *sink, void *data, tribox_report *report)
{
    call s = {.grid_f64 = grid, .options = options ? *options : (tribox_options){0}, .outlet = {.sink = sink, .data = data}};
    if (!grid || !starts || !scratch || !sink || !tribox_mesh_take(mesh, &s.mesh))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_status status = tribox_plan_make(options, &s.plan);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    const bool is_sound = tribox_grid_f64_is_sound(grid);
    tribox_environment_leave(callers);
    if (!is_sound)
        return TRIBOX_BAD_GRID;
    if (!is_share(&s, grid->size, tile, from, to, starts, list))
        return TRIBOX_BAD_ARGUMENT;
    if (!mesh->indices && !tribox_mesh_is_in_range(&s.mesh, s.plan.kernel, 0, mesh->count))
        return TRIBOX_BAD_VERTEX;
    use_scratch(&s, scratch);
    return finish_bricks(&s, emit_tiles(&s), report);
}
