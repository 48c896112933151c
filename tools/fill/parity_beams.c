/* parity_beams.c - which triangles the rays of each beam may cross, and the beams filled from these. */
#include "fill_tiles.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "console/message.h"
#include "console/system.h"
#include "read/mesh.h"
#include "tribox_threads.h"

/* ------------------------------------------------------------------------------------------------------------------------ lists */

typedef struct parity {
    const beams *beams;
    size_t *starts; /* of the list of each beam */
    uint32_t *list; /* triangles that its rays may cross, before and behind the grid too */
} parity;

/* The grid with two cells along x that reach over the mesh, in one tile: so tiles are the beams, on the same planes. */
static tribox_grid beam_grid(const tribox_grid *grid, double lo, double hi)
{
    const double half = hi / 2 - lo / 2, spacing = fmax(fabs(lo), fabs(hi)) * 0x1p-40;
    tribox_grid g = *grid;
    g.origin[0] = lo;
    g.cell[0] = fmin(1.001 * fmax(fmax(half, spacing), 0x1p-1000), DBL_MAX / 2 - lo / 2);
    g.size[0] = 2;
    return g;
}

static tribox_status list_beams(parity *p, const tribox_grid *grid)
{
    const voxel_task *const t = &p->beams->set->task;
    const tribox_tiles all = {p->beams->set->tile, 0, p->beams->count};
    const tribox_options listing = {.accuracy = TRIBOX_CONSERVATIVE, .kernel = t->options->kernel};
    return t->soup ? tribox_tile_lists(t->soup, grid, &all, &listing, p->starts, p->list)
                   : tribox_mesh_tile_lists(t->mesh, grid, &all, &listing, p->starts, p->list);
}

static tribox_status open_parity(const beams *b, const double x[2], unsigned threads, progress *bar, void **about)
{
    const tribox_grid grid = beam_grid(&b->set->task.grid, x[0], x[1]);
    parity *const p = calloc(1, sizeof *p);
    (void)threads, (void)bar;
    *about = p;
    if (!p)
        return MESSAGE_NO_MEMORY;
    p->beams = b;
    p->starts = malloc((b->count + 1) * sizeof *p->starts);
    const tribox_status status = p->starts ? list_beams(p, &grid) : MESSAGE_NO_MEMORY;
    if (status)
        return status;
    p->list = malloc(p->starts[b->count] * sizeof *p->list + 1);
    return p->list ? list_beams(p, &grid) : MESSAGE_NO_MEMORY;
}

static void close_parity(void *about)
{
    parity *const p = about;
    if (!p)
        return;
    free(p->starts);
    free(p->list);
    free(p);
}

/* ------------------------------------------------------------------------------------------------------------------------ beams */

typedef struct parity_room {
    tile_room *tile;
    size_t words;              /* of a beam */
    uint64_t *surface, *solid; /* two of them, in one room */
    void *scratch;
    uint32_t *numbers; /* the nine streams, or the corners, of the triangles of a beam */
} parity_room;

static size_t most_triangles(const parity *p)
{
    size_t most = 1;
    for (size_t b = 0; b < p->beams->count; b++)
        if (p->starts[b + 1] - p->starts[b] > most)
            most = p->starts[b + 1] - p->starts[b];
    return most;
}

static void end_room(void *data)
{
    parity_room *const r = data;
    tile_room_free(r->tile);
    pages_free(r->surface, 2 * r->words * sizeof *r->surface);
    free(r->scratch);
    free(r->numbers);
}

static uint32_t beam_side(uint32_t cells, uint32_t side) { return cells < side ? cells : side; }

static bool start_room(void *about, void *room)
{
    const parity *const p = about;
    const tile_set *const set = p->beams->set;
    const uint32_t *const grid = set->task.grid.size;
    const uint32_t size[3] = {grid[0], beam_side(grid[1], set->tile), beam_side(grid[2], set->tile)};
    parity_room *const r = room;
    r->words = tribox_window_words(size);
    r->surface = pages_take(2 * r->words * sizeof *r->surface);
    r->solid = r->surface ? r->surface + r->words : NULL;
    r->scratch = malloc(tribox_fill_bytes(size));
    r->numbers = malloc(9 * most_triangles(p) * sizeof *r->numbers);
    r->tile = tile_room_new(set, 0, set->count);
    return r->surface && r->scratch && r->numbers && r->tile;
}

/* The triangles of a list as nine streams. */
static tribox_soup gather_soup(const tribox_soup *from, const uint32_t *list, size_t count, float *to)
{
    const float *const *const axis[3] = {from->x, from->y, from->z};
    for (size_t k = 0; k < 9; k++)
        for (size_t i = 0; i < count; i++)
            to[k * count + i] = axis[k / 3][k % 3][list[i]];
    return soup_of_streams(to, count, count);
}

/* As a mesh with the same vertices. */
static tribox_mesh gather_mesh(const tribox_mesh *from, const uint32_t *list, size_t count, uint32_t *to)
{
    tribox_mesh own = *from;
    const uint32_t *const corners = from->indices;
    for (size_t i = 0; i < count; i++)
        for (size_t v = 0; v < 3; v++) {
            const size_t corner = 3 * (size_t)list[i] + v;
            to[3 * i + v] = corners ? corners[corner] : (uint32_t)corner;
        }
    own.indices = to;
    own.index_bytes = sizeof *to;
    own.count = count;
    return own;
}

static tribox_status fill_window(const parity *p, parity_room *r, size_t beam, const tribox_window *w, beam_found *found)
{
    const voxel_task *const t = &p->beams->set->task;
    const uint32_t *const list = p->list + p->starts[beam];
    const size_t count = p->starts[beam + 1] - p->starts[beam];
    if (t->soup) {
        const tribox_soup soup = gather_soup(t->soup, list, count, (float *)(void *)r->numbers);
        return tribox_fill_parity_window(&soup, &t->grid, w, r->surface, r->scratch, r->solid, &found->inside, &found->odd_rows);
    }
    const tribox_mesh own = gather_mesh(t->mesh, list, count, r->numbers);
    return tribox_mesh_fill_parity_window(&own, &t->grid, w, r->surface, r->scratch, r->solid, &found->inside, &found->odd_rows);
}

/* Tiles share the rows of the beam. */
static void hand_on(const parity *p, const parity_room *r, size_t beam, const tribox_window *w, beam_solid *solid)
{
    const size_t row_words = tribox_mask_words(w->size[0]);
    const fill_cells cells = p->beams->cells;
    const uint64_t *const words = cells == FILL_CELLS_INSIDE ? r->surface : r->solid; /* the inside took the place of the surface */
    const uint64_t *const inside = cells == FILL_CELLS_LABELLED ? r->surface : NULL;
    for (size_t n = 0; n < p->beams->tiles; n++) {
        const tribox_window tile = tile_cells_of(p->beams->set, beam * p->beams->tiles + n);
        const size_t before = tile.first[0] / 64;
        solid->tiles[solid->count++] =
            (tile_cells){tile, words + before, inside ? inside + before : NULL, row_words, tile.first[0] % 64};
    }
}

static tribox_status fill_beam(const void *about, void *room, size_t beam, beam_solid *solid, beam_found *found)
{
    const parity *const p = about;
    parity_room *const r = room;
    const size_t from = p->beams->first[beam], to = p->beams->first[beam + 1];
    tribox_window w = tile_cells_of(p->beams->set, beam * p->beams->tiles);
    w.size[0] = p->beams->set->task.grid.size[0];
    if (from == to && p->starts[beam] == p->starts[beam + 1])
        return TRIBOX_OK;
    tribox_status status = tile_words_take(p->beams->set, from, to, r->tile, &w, r->surface, &found->report);
    if (!status)
        status = fill_window(p, r, beam, &w, found);
    if (!status && p->beams->cells != FILL_CELLS_ALL)
        fill_keep_inside(r->surface, r->solid, tribox_window_words(w.size));
    if (!status)
        hand_on(p, r, beam, &w, solid);
    return status;
}

const beam_filling beam_parity = {open_parity, close_parity, sizeof(parity_room), start_room, fill_beam, end_room};
