/* bricks_vdb.c - bricks as a file of OpenVDB's, by the part of the program that knows it. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "brick_writer.h"
#include "console/message.h"
#include "vdb_part.h"

/*
 * The part stands beside the program's libraries. It is loaded for this format alone: OpenVDB takes four times as long to load as
 * all the rest, and three times the memory.
 */
static const vdb_part *load(void)
{
    void *const library = dlopen(VDB_PART_FILE, RTLD_NOW | RTLD_LOCAL);
    return library ? dlsym(library, VDB_PART_SYMBOL) : NULL;
}

/* A tree that the part has made. */
typedef struct vdb {
    const vdb_part *part;
    void *tree;
} vdb;

/*
 * OpenVDB takes no cells whose volume is below 3e-15: its lengths then are `unit` times those of the mesh, a power of ten. Infinite
 * where none would do.
 */
static double unit_of(const tribox_grid_f64 *grid)
{
    static const double volume_min = 1e-14, unit_max = 1e15;
    const double *const cell = grid->cell;
    double unit = 1;
    while (cell[0] * unit * (cell[1] * unit) * (cell[2] * unit) < volume_min)
        unit *= 10;
    return unit <= unit_max ? unit : INFINITY;
}

int bricks_check_vdb(const char *path, const tribox_grid_f64 *grid)
{
    const double unit = unit_of(grid);
    if (!load())
        return message_failure("%s: cannot load what writes .vdb: %s; write .npz", path, dlerror());
    if (isinf(unit))
        return message_failure("%s: cells of %.9g x %.9g x %.9g are too small for .vdb; write .npz", path, grid->cell[0],
                               grid->cell[1], grid->cell[2]);
    if (unit > 1)
        message_say("note: %s has lengths of the mesh times %.0f, as OpenVDB takes no cells as small as these", path, unit);
    return EXIT_CODE_OK;
}

static int fail(const brick_out *out, const char *reason)
{
    return message_failure("%s: OpenVDB failed: %s", out->file->path, reason);
}

static vdb_grid grid_of(const brick_out *out)
{
    const voxels *const v = &out->cells;
    vdb_grid grid = {.unit = unit_of(&v->grid), .is_mask = out->options.is_mask};
    for (int a = 0; a < 3; a++)
        grid.origin[a] = v->grid.origin[a] + v->shift[a];
    memcpy(grid.cell, v->grid.cell, sizeof grid.cell);
    memcpy(grid.shift, v->shift, sizeof grid.shift);
    memcpy(grid.size, v->grid.size, sizeof grid.size);
    return grid;
}

static int open_vdb(brick_out *out)
{
    char reason[VDB_REASON] = "out of memory";
    const vdb_grid grid = grid_of(out);
    vdb *const made = calloc(1, sizeof *made);
    if (made)
        made->part = load();
    if (made && made->part)
        made->tree = made->part->make(&grid, reason);
    if (made && made->tree) {
        out->state = made;
        return EXIT_CODE_OK;
    }
    free(made);
    return fail(out, reason);
}

static int put_vdb(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    const vdb *const to = out->state;
    char reason[VDB_REASON];
    return to->part->put(to->tree, at, bits, reason) ? EXIT_CODE_OK : fail(out, reason);
}

static int end_vdb(brick_out *out, progress *bar)
{
    const vdb *const from = out->state;
    const int can_seek = !file_out_is_stdout(out->file->path);
    char reason[VDB_REASON];
    (void)bar;
    return from->part->write(from->tree, out->to, can_seek, reason) || ferror(out->to) ? EXIT_CODE_OK : fail(out, reason);
}

static void drop_vdb(brick_out *out)
{
    vdb *const v = out->state;
    v->part->free(v->tree);
    free(v);
}

const brick_writer bricks_vdb = {.open = open_vdb, .put = put_vdb, .end = end_vdb, .drop = drop_vdb};
