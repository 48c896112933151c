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
#include "write/volume.h"
#include "write/voxels.h"

/* Each window of a fill looks at all triangles: there are twice as many as threads, so that none waits long, and no more. */
enum { EACH = 2, WINDOWS_MAX = EACH * THREADS_MAX };

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
    uint32_t windows;                                  /* of a fill: layers that a thread takes at once */
    void *scratch;                                     /* for all of them */
    size_t inside[WINDOWS_MAX], odd_rows[WINDOWS_MAX]; /* of each */
} whole;

static const char fewer_of[2][64] = {"choose fewer cells, or write bricks, -o FILE.npz or .vdb",
                                     "choose fewer cells, or leave out --thin"};

static size_t scratch_bytes(const whole *w)
{
    const uint32_t *const size = w->cells.grid.size;
    return tribox_fill_bytes((const uint32_t[3]){size[0], size[1], size[2] / w->windows + 1});
}

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
    bytes += is_filled ? w->windows * scratch_bytes(w) : 0;
    bytes += w->r->result.preview_path ? preview_memory(&w->r->result.look) : 0;
    code = voxels_check_memory(grid, bytes, fewer);
    if (code)
        return code;
    w->surface = pages_take(w->words * sizeof *w->surface);
    w->solid = is_filled ? pages_take(w->words * sizeof *w->solid) : NULL;
    return w->surface && (w->solid || !is_filled) ? EXIT_CODE_OK
                                                  : message_failure("out of memory for %zu words of cells", w->words);
}

static int take_coloured(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    whole *const w = data;
    const uint64_t cells = voxels_count(bits, 8);
    rgb *const of = cell_colours_add(&w->colours, at, bits, cells);
    if (!of)
        return 1;
    for (uint64_t n = 0; n < cells; n++)
        of[n] = w->in->colours->of[ids[n]];
    bricks_lay(w->cells.grid.size, w->surface, at, bits);
    return 0;
}

static int colour_cells(whole *w, const voxel_task *task, progress *bar, tribox_report *report)
{
    tile_set set;
    tile_found found;
    const int code = tile_set_of_task(task, false, w->r->threads, &set);
    if (code)
        return code;
    const tribox_status status = tile_crew_run(&set, 0, set.count, w->r->threads, &(tile_sink){take_coloured, w}, bar, &found);
    *report = found.report;
    tile_set_free(&set);
    if (status && status != TRIBOX_STOPPED)
        return message_status(status);
    return !status && cell_colours_place(&w->colours, task->grid.size)
               ? EXIT_CODE_OK
               : message_failure("out of memory for the colours of the cells");
}

static int run(whole *w, progress *bar, tribox_report *report)
{
    voxel_task task = voxelize_task(w->r, w->in);
    task.is_thin = w->r->is_thin;
    task.has_ids = w->in->colours != NULL;
    return task.has_ids ? colour_cells(w, &task, bar, report)
                        : message_status(voxelize_in_threads(&task, w->r->threads, w->surface, report, bar));
}

static int voxelize(whole *w, voxelize_answer *a)
{
    progress bar = progress_start("voxelizing");
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

static uint32_t border_of(const whole *w, size_t window)
{
    return (uint32_t)((uint64_t)w->cells.grid.size[2] * window / w->windows);
}

static int fill_window(void *data, void *place, size_t n)
{
    whole *const w = data;
    const mesh *const m = w->in->mesh;
    const tribox_grid *const grid = &w->cells.grid;
    const uint32_t from = border_of(w, n), layers = border_of(w, n + 1) - from;
    const tribox_window window = {{0, 0, from}, {grid->size[0], grid->size[1], layers}};
    const size_t before = voxels_layer_words(grid) * from;
    const uint64_t *const surface = w->surface + before;
    uint64_t *const solid = w->solid + before;
    void *const scratch = (char *)w->scratch + n * scratch_bytes(w);
    (void)place;
    return m->is_double
               ? (int)tribox_mesh_fill_parity_window(&m->doubles, grid, &window, surface, scratch, solid, &w->inside[n],
                                                     &w->odd_rows[n])
               : (int)tribox_fill_parity_window(&m->soup, grid, &window, surface, scratch, solid, &w->inside[n], &w->odd_rows[n]);
}

static int fill(whole *w, voxelize_answer *a)
{
    const double start = clock_seconds();
    size_t odd_rows = 0;
    if (w->r->fill == FILL_NONE)
        return EXIT_CODE_OK;
    w->scratch = malloc(w->windows * scratch_bytes(w));
    if (!w->scratch)
        return message_failure("out of memory to fill the cells");
    const crew_work windows = {.threads = w->r->threads, .count = w->windows, .step = fill_window};
    const int status = w->r->fill == FILL_OUTSIDE
                           ? (int)tribox_fill_outside(w->cells.grid.size, w->surface, w->scratch, w->solid, w->inside)
                           : crew_do(&windows, w);
    free(w->scratch);
    if (status)
        return message_status((tribox_status)status);
    if (w->r->fill == FILL_MIDDLES)
        a->seconds = clock_seconds() - start; /* all that there is to do */
    if (w->r->cells != FILL_CELLS_ALL)
        fill_keep_inside(w->surface, w->solid, w->words);
    for (uint32_t n = 0; n < w->windows; n++) {
        a->inside += w->inside[n];
        odd_rows += w->odd_rows[n];
    }
    voxelize_note_rows(odd_rows, a);
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
    progress bar = progress_start("writing");
    if (!r->is_count)
        code = brick_out_voxels(r->result.format, &r->result.options, &files->out, v, tile, r->threads, &bricks, &bar);
    else
        code = bricks_cut(v, tile, count_brick, &bricks, &bar);
    progress_end(&bar);
    a->has_bricks = r->is_count || volume_kind_of(r->result.format) == VOLUME_SPARSE;
    a->bricks = bricks;
    return code;
}

static int write_files(const whole *w, voxelize_files *files, voxelize_answer *a)
{
    const fill_cells cells = w->r->cells;
    voxels v = w->cells;
    v.words = w->solid && cells != FILL_CELLS_INSIDE ? w->solid : w->surface;
    v.inside = cells == FILL_CELLS_LABELLED ? w->surface : NULL;
    v.colours = w->in->colours ? &w->colours : NULL;
    int code = put_cells(w, &v, files, a);
    if (!code)
        code = file_out_keep(&files->out);
    return code ? code : preview_draw(&files->picture, &v, &w->r->result.look, w->r->threads);
}

int voxelize_whole(const voxelize_request *r, const voxelize_input *in, voxelize_files *files, voxelize_answer *a)
{
    const uint32_t layers = in->cells.grid.size[2], windows = r->threads > 1 ? EACH * r->threads : 1;
    whole w = {.r = r, .in = in, .cells = in->cells, .windows = windows < layers ? windows : layers};
    int code = take_memory(&w);
    if (!code)
        code = voxelize(&w, a);
    if (!code)
        code = fill(&w, a);
    if (!code)
        code = make_palette(&w);
    if (!code)
        code = write_files(&w, files, a);
    cell_colours_free(&w.colours);
    pages_free(w.solid, w.words * sizeof *w.solid);
    pages_free(w.surface, w.words * sizeof *w.surface);
    return code;
}
