/*
 * cell_lists.c - which triangles overlap which cell of a window: pairs, which kernels list in place of bits, are counted, and then
 * put into lists.
 */
#include "base/environment.h"
#include "grid/blocks.h"
#include "tile_lists.h"
#include "voxels/voxelizing.h"

/* One pass. Cells have the numbers that their ids would have. */
typedef struct cells_call {
    tribox_cell_ids cells; /* without ids: where the cells of a word begin */
    char *counts;          /* the first pass: a number of 32 bits for each cell, at any alignment; */
    const size_t *starts;  /* or the second */
    uint32_t *list;
    const tribox_tiles_call *cut; /* the tiles that the cells are, where borders of the grid cut some of them; else NULL */
} cells_call;

/* Where memory is asked for before it is used, in entries. */
enum { COUNT_AHEAD = 32, START_AHEAD = 48, LIST_AHEAD = 24, ROOM = sizeof(((tribox_writes *)0)->bits) / sizeof(int32_t) };

/* The first cell of each entry; returns how many entries there are. */
static unsigned find_cells(const cells_call *l, const tribox_writes *listed, size_t cell[ROOM])
{
    for (unsigned n = 0; n < listed->count; n++) {
        const uint32_t half = (uint32_t)listed->half[n];
        cell[n] = tribox_ids_at_word(&l->cells, half / 2) + half % 2 * 32 + tribox_lowest_bit((uint32_t)listed->bits[n]);
    }
    return listed->count;
}

static void tell_taken(void *is_taken, const int64_t at[3])
{
    (void)at;
    *(bool *)is_taken = true;
}

/* Whether the last tiles of an axis are cut, and this is one. */
static bool is_cut(const tribox_tiling *t, int a, int64_t at) { return t->size[a] % t->side && at == (int64_t)t->along[a] - 1; }

/* Whether the bounding box touches the tile on an axis; ends: whether it ends there, too. */
static bool is_box_at(const tribox_tiles_call *cut, const double w[3], int a, int64_t tile, bool *ends)
{
    const double low = tribox_tile_plane(cut, a, tile), high = tribox_tile_plane(cut, a, tile + 1);
    *ends = w[0] <= high && w[1] <= high && w[2] <= high;
    return (w[0] >= low || w[1] >= low || w[2] >= low) && (w[0] <= high || w[1] <= high || w[2] <= high);
}

/* As it is cut: the pair is about more, but for a triangle that goes on nowhere beyond the grid. */
static bool overlaps_cut_tile(const tribox_tiles_call *cut, uint32_t triangle, const int64_t at[3])
{
    static const int64_t one[3] = {1, 1, 1};
    double u[9];
    bool is_taken = false, is_within = cut->plan.axes == TRIBOX_AXES_ALL, ends;
    const tribox_blocks blocks = {
        .plan = &cut->plan, .plane = tribox_tile_plane, .lattice = cut, .take = tell_taken, .taker = &is_taken};
    tribox_triangles_read(cut->triangles, triangle, 1, u, 1);
    for (int a = 0; a < 3; a++) {
        if (!is_box_at(cut, u + 3 * a, a, at[a], &ends))
            return false;
        is_within = is_within && (ends || !is_cut(&cut->tiling, a, at[a]));
    }
    if (!is_within)
        tribox_blocks_ask(&blocks, u, at, one);
    return is_within || is_taken;
}

/* The cells of an entry, of which this is the first, without the cut tiles that the triangle does not overlap. */
static uint32_t bits_within(const tribox_tiles_call *cut, size_t cell, uint32_t bits, uint32_t triangle)
{
    const tribox_tiling *const t = &cut->tiling;
    const uint32_t row = (uint32_t)cell / (uint32_t)t->along[0], layer = row / (uint32_t)t->along[1];
    const int64_t first[3] = {(int64_t)(cell - row * t->along[0]), (int64_t)(row - layer * t->along[1]), layer};
    const bool is_row_cut = is_cut(t, 1, first[1]) || is_cut(t, 2, first[2]);
    for (uint32_t left = bits; left; left &= left - 1) {
        const int64_t at[3] = {first[0] + tribox_lowest_bit(left), first[1], first[2]};
        if ((is_row_cut || is_cut(t, 0, at[0])) && !overlaps_cut_tile(cut, triangle, at))
            bits &= ~(left & -left);
    }
    return bits;
}

/* The cells of entry n from its first one on. */
static inline uint32_t bits_of(const cells_call *l, const tribox_writes *listed, unsigned n, size_t cell, uint32_t first)
{
    const uint32_t bits = (uint32_t)listed->bits[n] >> tribox_lowest_bit((uint32_t)listed->bits[n]);
    return TRIBOX_TILES_AS_CELLS && l->cut ? bits_within(l->cut, cell, bits, first + (uint32_t)listed->number[n]) : bits;
}

static void count_one(char *count)
{
    uint32_t n;
    memcpy(&n, count, sizeof n);
    n++;
    memcpy(count, &n, sizeof n);
}

static void count_pairs(void *call, const tribox_writes *listed, uint32_t first)
{
    const cells_call *const l = call;
    size_t cell[ROOM];
    const unsigned count = find_cells(l, listed, cell);
    for (unsigned n = 0; n < count; n++) {
        char *const to = l->counts + sizeof(uint32_t) * cell[n];
        if (n + COUNT_AHEAD < count)
            tribox_will_write(l->counts + sizeof(uint32_t) * cell[n + COUNT_AHEAD]);
        for (uint32_t bits = bits_of(l, listed, n, cell[n], first); bits; bits &= bits - 1)
            count_one(to + sizeof bits * tribox_lowest_bit(bits));
    }
}

/*
 * Into the list of a cell, which is zero before its first triangle, and in its last place counts those it has until it is full. Few
 * have a greater number: only those that came while this one waited (PROOFS.md 7.14).
 */
static void put_in_cell(const cells_call *l, size_t cell, uint32_t number)
{
    uint32_t *const to = l->list + l->starts[cell], *const last = l->list + l->starts[cell + 1] - 1;
    const uint32_t has = *last;
    tribox_list_put(to, has, number);
    *last = to + has == last ? *last : has + 1;
}

static void put_pairs(void *call, const tribox_writes *listed, uint32_t first)
{
    const cells_call *const l = call;
    size_t cell[ROOM];
    const unsigned count = find_cells(l, listed, cell);
    for (unsigned n = 0; n < count; n++) {
        if (n + START_AHEAD < count)
            tribox_will_read(l->starts + cell[n + START_AHEAD]);
        if (n + LIST_AHEAD < count)
            tribox_will_write(l->list + l->starts[cell[n + LIST_AHEAD]]);
        for (uint32_t bits = bits_of(l, listed, n, cell[n], first); bits; bits &= bits - 1)
            put_in_cell(l, cell[n] + tribox_lowest_bit(bits), first + (uint32_t)listed->number[n]);
    }
}

/*
 * Where lists begin, out of the counts, which are in the upper half of the same memory: the number that is written is never above
 * the count that is read. Whether a list of all can be addressed.
 */
static bool sum_counts(size_t *starts, const char *counts, size_t cells)
{
    enum { BLOCK = 1 << 16 };
    uint64_t sum = 0;
    starts[0] = 0;
    for (size_t at = 0, end; at < cells; at = end) {
        end = cells - at < BLOCK ? cells : at + BLOCK;
        for (size_t c = at; c < end; c++) {
            uint32_t count;
            memcpy(&count, counts + c * sizeof count, sizeof count);
            sum += count;
            starts[c + 1] = (size_t)sum;
        }
        if (sum > SIZE_MAX / sizeof(uint32_t))
            return false;
    }
    return true;
}

static void pair_window(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                        cells_call *l)
{
    const tribox_pair_sink sink = {l->list ? put_pairs : count_pairs, l};
    tribox_voxels_begin_window(v, triangles, grid, window, NULL);
    l->cells.row_words = (uint32_t)v->sinks.row_words;
    l->cells.gap = (uint32_t)(64 * (uint64_t)v->sinks.row_words - v->window.size[0]);
    tribox_voxels_ask_pairs(v, &sink);
    tribox_voxels_put_all(v, triangles);
    tribox_voxels_end(v);
}

static tribox_status list_pairs(tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid,
                                const tribox_window *window, const tribox_tiles_call *cut, size_t cells, size_t *starts,
                                uint32_t *list)
{
    cells_call l = {.counts = (char *)(starts + 1 + cells) - cells * sizeof(uint32_t), .starts = starts, .list = list, .cut = cut};
    if (!cells)
        return starts[0] = 0, TRIBOX_OK;
    if (list && triangles->count)
        memset(list, 0, starts[cells] * sizeof *list);
    else if (!list)
        memset(l.counts, 0, cells * sizeof(uint32_t));
    pair_window(v, triangles, grid, window, &l);
    return list || sum_counts(starts, l.counts, cells) ? TRIBOX_OK : TRIBOX_BAD_GRID;
}

/* Whether the kernel lists the pairs: those that it would set the bits of, each counted in 32 bits. */
static bool are_pairs_listed(const tribox_voxels *v, const tribox_triangles *triangles, const tribox_grid *grid,
                             const tribox_window *window)
{
    return v->plan.axes & TRIBOX_AXES_BOX && triangles->count <= UINT32_MAX && !tribox_grid_check_window(grid, window) &&
           tribox_tile_count(window->size, 1) < SIZE_MAX && tribox_triangles_have_vertices(triangles, v->plan.kernel);
}

/* All others, and errors, are those of tiles of one cell. */
static tribox_status list_cells(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_window *window,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_voxels voxels, *const v = &voxels;
    if (!grid)
        return TRIBOX_BAD_ARGUMENT;
    const tribox_window asked = window ? *window : tribox_whole_window(grid);
    const tribox_tiles cells = {.side = 1, .count = tribox_tile_count(asked.size, 1)};
    if (!starts || tribox_plan_make(options, &v->plan))
        return tribox_tiles_list(triangles, grid, &asked, &cells, options, starts, list);
    v->plan.accuracy = v->plan.accuracy == TRIBOX_FAST ? TRIBOX_CONSERVATIVE : v->plan.accuracy;
    const tribox_environment callers = tribox_environment_enter();
    const tribox_status status = are_pairs_listed(v, triangles, grid, &asked)
                                     ? list_pairs(v, triangles, grid, &asked, NULL, cells.count, starts, list)
                                     : tribox_tiles_list(triangles, grid, &asked, &cells, options, starts, list);
    tribox_environment_leave(callers);
    return status;
}

static bool are_tiles_cut(const tribox_tiling *t) { return t->size[0] % t->side || t->size[1] % t->side || t->size[2] % t->side; }

/* Whether all tiles of the grid are listed, and it is worth it: a power of two of cells a side, but not many. */
static bool are_cells_listed(const tribox_grid *grid, const tribox_tiles *tiles, tribox_tiling *t)
{
    enum { SIDE_MOST = 8, CUT_MOST = 4 };
    if (!tiles->side || tiles->side > SIDE_MOST || tiles->side & (tiles->side - 1) || !tribox_tiling_make(grid->size, tiles, t) ||
        tiles->count != t->tiles)
        return false;
    return !are_tiles_cut(t) || (tiles->side <= CUT_MOST && t->tiles <= UINT32_MAX);
}

/* The grid whose cells the tiles are, but those that the borders cut: its planes are numbers of the grid's (PROOFS.md 7.12). */
static bool make_coarse_grid(const tribox_grid *grid, const tribox_tiling *t, tribox_grid *coarse)
{
    *coarse = *grid;
    for (int a = 0; a < 3; a++) {
        coarse->size[a] = (uint32_t)t->along[a];
        coarse->cell[a] *= t->side;
    }
    return tribox_grid_is_sound(coarse);
}

bool tribox_cells_list_tiles(const tribox_triangles *triangles, const tribox_grid *grid, const tribox_tiles *tiles,
                             const tribox_options *options, size_t *starts, uint32_t *list, tribox_status *status)
{
    tribox_voxels voxels, *const v = &voxels;
    tribox_tiles_call cut = {.triangles = triangles};
    tribox_grid coarse;
    if (!TRIBOX_TILES_AS_CELLS || !grid || !tiles || !starts || tribox_plan_make(options, &v->plan) ||
        v->plan.accuracy != TRIBOX_EXACT || !are_cells_listed(grid, tiles, &cut.tiling))
        return false;
    const tribox_environment callers = tribox_environment_enter();
    bool are_listed = tribox_grid_is_sound(grid) && make_coarse_grid(grid, &cut.tiling, &coarse);
    const tribox_window whole = tribox_whole_window(are_listed ? &coarse : grid);
    are_listed = are_listed && are_pairs_listed(v, triangles, &coarse, &whole);
    if (are_listed) {
        cut.plan = v->plan;
        cut.planes = tribox_planes_of(grid, NULL);
        *status = list_pairs(v, triangles, &coarse, &whole, are_tiles_cut(&cut.tiling) ? &cut : NULL, tiles->count, starts, list);
    }
    tribox_environment_leave(callers);
    return are_listed;
}

tribox_status tribox_cell_lists(const tribox_soup *soup, const tribox_grid *grid, const tribox_window *window,
                                const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_soup(soup, &triangles) ? list_cells(&triangles, grid, window, options, starts, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}

tribox_status tribox_mesh_cell_lists(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_window *window,
                                     const tribox_options *options, size_t *starts, uint32_t *list)
{
    tribox_triangles triangles;
    return tribox_triangles_of_mesh(mesh, &triangles) ? list_cells(&triangles, grid, window, options, starts, list)
                                                      : TRIBOX_BAD_ARGUMENT;
}
