/* bricks_vdb.c - bricks as a file of OpenVDB's, by the part of the program that knows it. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
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

int bricks_check_vdb(const char *path, const tribox_grid_f64 *grid)
{
    (void)grid;
    return load() ? EXIT_CODE_OK : message_failure("%s: cannot load what writes .vdb: %s; write .npz", path, dlerror());
}

static int fail(const brick_out *out, const char *reason)
{
    return message_failure("%s: OpenVDB failed: %s", out->file->path, reason);
}

static vdb_grid grid_of(const brick_out *out)
{
    const voxels *const v = &out->cells;
    vdb_grid grid = {.is_of_booleans = out->options.is_of_booleans};
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
    const int code = bricks_check_vdb(out->file->path, &out->cells.grid);
    if (code)
        return code;
    vdb *const made = malloc(sizeof *made);
    if (made) {
        made->part = load();
        made->tree = made->part->make(&grid, reason);
    }
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
