/* bricks_vdb.c - bricks as a file of OpenVDB's, by a process that knows it. */
#include <errno.h>
#include <math.h>
#include <string.h>

#include "brick_writer.h"
#include "colours/cell_colours.h"
#include "console/message.h"
#include "vdb_process.h"

/*
 * OpenVDB takes no cells whose volume is below 3e-15: its lengths then are `unit` times those of the mesh, a power of ten. Infinite
 * where none would do.
 */
static double unit_of(const tribox_grid *grid)
{
    static const double volume_min = 1e-14, unit_max = 1e15;
    const double *const cell = grid->cell;
    double unit = 1;
    while (cell[0] * unit * (cell[1] * unit) * (cell[2] * unit) < volume_min)
        unit *= 10;
    return unit <= unit_max ? unit : INFINITY;
}

static vdb_grid grid_of(const voxels *v, const volume_options *options)
{
    vdb_grid grid = {.unit = unit_of(&v->grid),
                     .is_mask = options->is_mask,
                     .has_labels = options->has_labels,
                     .has_colours = v->colours != NULL,
                     .has_ids = options->has_ids};
    for (int a = 0; a < 3; a++)
        grid.origin[a] = v->grid.origin[a] + v->shift[a];
    memcpy(grid.cell, v->grid.cell, sizeof grid.cell);
    memcpy(grid.shift, v->shift, sizeof grid.shift);
    memcpy(grid.size, v->grid.size, sizeof grid.size);
    return grid;
}

static int fail(const char *path, const char *reason) { return message_failure("%s: %s; write .npz", path, reason); }

/* Begun while the mesh is read, tried when there is a grid, and then at work for one file. */
static vdb_process *begun;

static rgb_curve curve;

void bricks_begin_vdb(void)
{
    char reason[VDB_PROCESS_REASON];
    if (!begun)
        begun = vdb_process_begin(reason); /* the check says why not */
}

static void end_begun(void)
{
    if (begun)
        vdb_process_free(begun);
    begun = NULL;
}

static bool try_grid(const vdb_grid *grid, char *reason)
{
    if (!begun)
        begun = vdb_process_begin(reason);
    return begun && vdb_process_try(begun, grid, reason);
}

/* Before the work that what cannot be written would waste. */
int bricks_check_vdb(const char *path, const tribox_grid *grid)
{
    char reason[VDB_PROCESS_REASON];
    const vdb_grid tried = grid_of(&(voxels){.grid = *grid}, &(volume_options){.is_mask = false});
    if (isinf(tried.unit))
        return message_failure("%s: cells of %.9g x %.9g x %.9g are too small for .vdb; write .npz", path, grid->cell[0],
                               grid->cell[1], grid->cell[2]);
    if (!try_grid(&tried, reason)) {
        end_begun();
        return fail(path, reason);
    }
    if (tried.unit > 1)
        message_say("note: %s has lengths of the mesh times %.0f, as OpenVDB takes no cells as small as these", path, tried.unit);
    return EXIT_CODE_OK;
}

static int open_vdb(brick_out *out)
{
    char reason[VDB_PROCESS_REASON];
    curve = rgb_curve_make();
    const vdb_grid grid = grid_of(&out->cells, &out->options);
    if (!begun)
        begun = vdb_process_begin(reason);
    if (!begun || !vdb_process_open(begun, &grid, out->to, !file_out_is_stdout(out->file->path), reason)) {
        end_begun();
        return fail(out->file->path, reason);
    }
    out->state = begun;
    begun = NULL;
    return EXIT_CODE_OK;
}

/* As light. Returns how many. */
static uint32_t find_colours(const cell_colours *c, const uint32_t at[3], const uint64_t bits[8], float (*to)[3])
{
    const rgb *const from = cell_colours_of_brick(c, at);
    const uint32_t cells = (uint32_t)voxels_count(bits, 8);
    for (uint32_t n = 0; n < cells; n++)
        for (int a = 0; a < 3; a++)
            to[n][a] = curve.light[from[n].at[a]];
    return cells;
}

static int put_vdb(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    enum { CELLS = 512 };
    char reason[VDB_PROCESS_REASON];
    float colours[CELLS][3];
    const void *values = colours;
    uint32_t cells = 0;
    if (out->cells.colours) {
        cells = find_colours(out->cells.colours, at, bits, colours);
    } else if (out->options.has_ids) {
        cells = (uint32_t)voxels_count(bits, 8);
        values = out->ids;
    }
    return vdb_process_put(out->state, at, bits, out->inside, values, cells, reason) ? EXIT_CODE_OK : fail(out->file->path, reason);
}

static int end_vdb(brick_out *out, progress *bar)
{
    char reason[VDB_PROCESS_REASON];
    int error;
    (void)bar;
    if (vdb_process_write(out->state, &error, reason))
        return EXIT_CODE_OK;
    errno = error;
    return error ? file_out_failure(out->file) : fail(out->file->path, reason);
}

static void drop_vdb(brick_out *out) { vdb_process_free(out->state); }

const brick_writer bricks_vdb = {.open = open_vdb, .put = put_vdb, .end = end_vdb, .drop = drop_vdb};
