/* voxelize_whole.c - a mesh into the words of its whole grid: formats of all cells, filling, and whatever fits the caches. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <string.h>

#include "colours/colours.h"
#include "console/clock.h"
#include "console/crew.h"
#include "console/system.h"
#include "console/message.h"
#include "console/progress.h"
#include "voxel_task.h"
#include "read/mesh.h"
#include "tile_set.h"
#include "tribox_threads.h"
#include "voxelize_work.h"
#include "write/brick_out.h"
#include "write/voxels.h"

/* ---------------------------------------------------------------------------------------------------------------------- colours */

typedef struct colouring {
    const tribox_grid *grid;
    const mesh_colours *colours;
    uint64_t *words;
    cell_colours *to;
} colouring;

static int take_coloured(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    colouring *const c = data;
    const uint64_t cells = voxels_count(bits, 8);
    rgb *const of = cell_colours_add(c->to, at, bits, cells);
    if (!of)
        return 1;
    for (uint64_t n = 0; n < cells; n++)
        of[n] = c->colours->of[ids[n]];
    bricks_lay(c->grid, c->words, at, bits);
    return 0;
}

static int colour_tiles(const tile_set *set, unsigned threads, colouring *c, progress *bar, tribox_report *report)
{
    tile_found found;
    const tribox_status status = tile_crew_run(set, 0, set->count, threads, &(tile_sink){take_coloured, c}, bar, &found);
    *report = found.report;
    if (status && status != TRIBOX_STOPPED)
        return message_status(status);
    return !status && cell_colours_place(c->to, set->task.grid.size)
               ? EXIT_CODE_OK
               : message_failure("out of memory for the colours of the cells");
}

static int colour_cells(const voxel_task *task, const mesh_colours *colours, unsigned threads, uint64_t *words, cell_colours *cells,
                        progress *bar, tribox_report *report)
{
    tile_set set;
    *cells = (cell_colours){.count = 0};
    int code = tile_set_of_task(task, false, threads, &set);
    if (code)
        return code;
    colouring c = {.grid = &task->grid, .colours = colours, .words = words, .to = cells};
    code = colour_tiles(&set, threads, &c, bar, report);
    tile_set_free(&set);
    if (code)
        cell_colours_free(cells);
    return code;
}

/* ---------------------------------------------------------------------------------------------------------------------- insides */

/* The words of a grid, and what is found. */
typedef struct whole_fill {
    const tribox_grid *grid;
    const uint64_t *surface;
    uint64_t *solid;
    void *scratch; /* fill_whole_bytes */
    size_t inside, odd_rows;
} whole_fill;

/* Each window looks at all triangles: there are twice as many as threads, so that none waits long, and no more. */
enum { EACH = 2 };

typedef struct layer_fill {
    const mesh *m;
    whole_fill *f;
    uint32_t windows;
    size_t inside[EACH * THREADS_MAX], odd_rows[EACH * THREADS_MAX]; /* of each */
} layer_fill;

static uint32_t windows_of(const tribox_grid *grid, unsigned threads)
{
    const uint32_t wanted = threads > 1 ? EACH * threads : 1;
    return wanted < grid->size[2] ? wanted : grid->size[2];
}

/* Layers from .. to - 1. */
static uint32_t border_of(const layer_fill *l, uint32_t window)
{
    return (uint32_t)((uint64_t)l->f->grid->size[2] * window / l->windows);
}

static size_t window_bytes(const tribox_grid *grid, uint32_t windows)
{
    return tribox_fill_bytes((const uint32_t[3]){grid->size[0], grid->size[1], grid->size[2] / windows + 1});
}

static size_t fill_whole_bytes(const tribox_grid *grid, unsigned threads)
{
    const uint32_t windows = windows_of(grid, threads);
    return windows * window_bytes(grid, windows);
}

static int fill_layers(void *data, void *place, size_t n)
{
    layer_fill *const l = data;
    const tribox_grid *const grid = l->f->grid;
    const uint32_t from = border_of(l, (uint32_t)n), layers = border_of(l, (uint32_t)n + 1) - from;
    const tribox_window w = {{0, 0, from}, {grid->size[0], grid->size[1], layers}};
    const size_t before = tribox_mask_words(grid->size[0]) * grid->size[1] * from;
    const uint64_t *const surface = l->f->surface + before;
    uint64_t *const solid = l->f->solid + before;
    size_t *const inside = &l->inside[n], *const odd_rows = &l->odd_rows[n];
    void *const scratch = (char *)l->f->scratch + n * window_bytes(grid, l->windows);
    (void)place;
    return l->m->is_double
               ? (int)tribox_mesh_fill_parity_window(&l->m->doubles, grid, &w, surface, scratch, solid, inside, odd_rows)
               : (int)tribox_fill_parity_window(&l->m->soup, grid, &w, surface, scratch, solid, inside, odd_rows);
}

static tribox_status fill_whole(const mesh *m, unsigned threads, whole_fill *f)
{
    layer_fill l = {.m = m, .f = f, .windows = windows_of(f->grid, threads)};
    f->inside = f->odd_rows = 0;
    if (!m)
        return tribox_fill_outside(f->grid->size, f->surface, f->scratch, f->solid, &f->inside);
    const int status = crew_do(&(crew_work){.threads = threads, .count = l.windows, .step = fill_layers}, &l);
    for (uint32_t n = 0; n < l.windows; n++) {
        f->inside += l.inside[n];
        f->odd_rows += l.odd_rows[n];
    }
    return (tribox_status)status;
}

/* -------------------------------------------------------------------------------------------------------------------------- all */

/*
 * What the work is about. The words are the cells of the surface, and in `solid` those that it encloses too. Where the inside is
 * asked for it takes the place of the surface.
 */
typedef struct whole {
    const voxelize_request *r;
    const voxelize_input *in;
    voxels cells;
    size_t words;
    uint64_t *surface, *solid; /* solid: NULL without a fill */
    cell_colours colours;
} whole;

static const char fewer_of[2][64] = {"choose fewer cells, or write bricks, -o FILE.npz or .vdb",
                                     "choose fewer cells, or leave out --thin"};

static int take_memory(whole *w)
{
    const tribox_grid *const grid = &w->cells.grid;
    const bool is_filled = w->r->fill != FILL_NONE;
    const char *const fewer = fewer_of[w->r->is_thin];
    int code = voxels_check_words(grid, fewer);
    if (code)
        return code;
    w->words = voxels_layer_words(grid) * grid->size[2];
    uint64_t bytes = (uint64_t)w->words * sizeof(uint64_t) * (is_filled ? 2 : 1);
    bytes += is_filled ? fill_whole_bytes(grid, w->r->threads) : 0;
    bytes += w->r->result.preview_path ? preview_memory(&w->r->result.look) : 0;
    code = voxels_check_memory(grid, bytes, fewer);
    if (code)
        return code;
    w->surface = pages_take(w->words * sizeof *w->surface);
    w->solid = is_filled ? pages_take(w->words * sizeof *w->solid) : NULL;
    return w->surface && (w->solid || !is_filled) ? EXIT_CODE_OK
                                                  : message_failure("out of memory for %zu words of cells", w->words);
}

static int run(whole *w, progress *bar, tribox_report *report)
{
    voxel_task task = voxelize_task(w->r, w->in);
    task.is_thin = w->r->is_thin;
    task.has_ids = w->in->colours != NULL;
    if (task.has_ids)
        return colour_cells(&task, w->in->colours, w->r->threads, w->surface, &w->colours, bar, report);
    return message_status(voxelize_in_threads(&task, w->r->threads, w->surface, report, bar));
}

static int voxelize(whole *w, voxelize_answer *a)
{
    progress bar = progress_start("voxelizing", !w->r->result.is_quiet);
    const double start = clock_seconds();
    const int code = w->r->fill == FILL_MIDDLES ? EXIT_CODE_OK : run(w, &bar, &a->report);
    a->seconds = clock_seconds() - start;
    progress_end(&bar);
    return code;
}

/* What a format with a palette needs. */
static int make_palette(whole *w)
{
    return w->in->colours && volume_holds(w->r->result.format, "of a palette")
               ? cell_colours_make_palette(&w->colours, w->r->result.out_path)
               : EXIT_CODE_OK;
}

static int fill_if_wanted(const whole *w, voxelize_answer *a)
{
    if (w->r->fill == FILL_NONE)
        return EXIT_CODE_OK;
    whole_fill f = {.grid = &w->cells.grid, .surface = w->surface, .solid = w->solid};
    f.scratch = malloc(fill_whole_bytes(f.grid, w->r->threads));
    if (!f.scratch)
        return message_failure("out of memory to fill the cells");
    const double start = clock_seconds();
    const tribox_status status = fill_whole(w->r->fill == FILL_OUTSIDE ? NULL : w->in->mesh, w->r->threads, &f);
    free(f.scratch);
    if (status)
        return message_status(status);
    if (w->r->fill == FILL_MIDDLES)
        a->seconds = clock_seconds() - start; /* all that there is to do */
    if (w->r->cells != FILL_CELLS_ALL)
        fill_keep_inside(w->surface, w->solid, w->words);
    a->inside = f.inside;
    voxelize_note_rows(f.odd_rows, a);
    return EXIT_CODE_OK;
}

static int count_brick(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at, (void)bits;
    ++*(uint64_t *)data;
    return EXIT_CODE_OK;
}

/* The cells are what tiles would have found: bricks come in their order, and are counted but where a mesh is made of the words. */
static int put_cells(const whole *w, const voxels *v, voxelize_files *files, voxelize_answer *a)
{
    const voxelize_request *const r = w->r;
    const uint32_t tile = tile_set_side(v->grid.size, false);
    uint64_t bricks = 0;
    int code = EXIT_CODE_OK;
    progress bar = progress_start("writing", !r->result.is_quiet);
    if (!r->is_count)
        code = brick_out_voxels(r->result.format, &r->result.options, &files->out, v, tile, r->threads, &bricks, &bar);
    else
        code = bricks_cut(v, tile, count_brick, &bricks, &bar);
    progress_end(&bar);
    a->has_bricks = r->is_count || !strcmp(volume_kind(r->result.format), "sparse");
    a->bricks = bricks;
    return code;
}

static int write_files(const whole *w, voxelize_files *files, voxelize_answer *a)
{
    const fill_cells cells = w->r->cells;
    const voxels_slab slab = {.layers = w->cells.grid.size[2],
                              .bits = w->solid && cells != FILL_CELLS_INSIDE ? w->solid : w->surface,
                              .inside = cells == FILL_CELLS_LABELLED ? w->surface : NULL};
    voxels v = w->cells;
    v.slab = &slab;
    v.slabs = 1;
    v.colours = w->in->colours ? &w->colours : NULL;
    int code = put_cells(w, &v, files, a);
    if (!code)
        code = file_out_keep(&files->out);
    return code ? code : preview_draw(&files->picture, &v, &w->r->result.look, w->r->threads, !w->r->result.is_quiet);
}

int voxelize_whole(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a)
{
    whole w = {.r = r, .in = in, .cells = in->cells};
    int code = take_memory(&w);
    if (!code)
        code = voxelize(&w, a);
    if (!code)
        code = fill_if_wanted(&w, a);
    if (!code)
        code = make_palette(&w);
    if (!code)
        code = write_files(&w, files, a);
    cell_colours_free(&w.colours);
    pages_free(w.solid, w.words * sizeof *w.solid);
    pages_free(w.surface, w.words * sizeof *w.surface);
    return code;
}
