/* bricks_npz.c - bricks as arrays for numpy.load: where they are, their bits, what is known of these, and the grid. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "colours/colours.h"
#include "console/message.h"
#include "part.h"
#include "read/little.h"
#include "volume.h"

#define PLACE(member) offsetof(part_header, member)

const npz_array npz_arrays[NPZ_END] = {
    [NPZ_BITS] = {{"bits.npy", "<u8", 8, 64}, 0, 0},
    [NPZ_AT] = {{"at.npy", "<u4", 3, 12}, 0, 0},
    [NPZ_IDS] = {{"ids.npy", "<u4", 0, 4}, 0, 0},
    [NPZ_INSIDE] = {{"inside.npy", "<u8", 8, 64}, 0, 0},
    [NPZ_COLOURS] = {{"colours.npy", "|u1", 3, 3}, 0, 0},
    [NPZ_ORIGIN] = {{"origin.npy", "<f8", 0, 8}, 3, PLACE(whole.cells.grid.origin)},
    [NPZ_CELL] = {{"cell.npy", "<f8", 0, 8}, 3, PLACE(whole.cells.grid.cell)},
    [NPZ_SIZE] = {{"size.npy", "<u4", 0, 4}, 3, PLACE(whole.cells.grid.size)},
    [NPZ_SHIFT] = {{"shift.npy", "<f8", 0, 8}, 3, PLACE(whole.cells.shift)},
    [NPZ_SHARD] = {{"shard.npy", "<u4", 0, 4}, 2, PLACE(shard)},
    [NPZ_TILES] = {{"tiles.npy", "<u8", 0, 8}, 2, PLACE(from)},
    [NPZ_WHOLE] = {{"whole.npy", "<u8", 0, 8}, 7, PLACE(whole.triangles)},
};

static void add_about(zip_out *zip, const part_header *of)
{
    for (int array = NPZ_ORIGIN; array < (of->shard ? NPZ_END : NPZ_SHARD); array++) {
        unsigned char row[NPZ_ROW_MOST];
        const npz_array *const a = &npz_arrays[array];
        memcpy(row, (const unsigned char *)of + a->place, a->rows * a->npy.row_bytes);
        little_turn(row, a->rows, a->npy.row_bytes);
        zip_add_array(zip, &a->npy, a->rows, row);
    }
}

enum { BLOCK = 512 };

/* The file gets the bits as they come; what else there is of bricks and cells waits in files beside it. */
typedef struct npz {
    zip_out zip;
    FILE *waiting[NPZ_ORIGIN]; /* NULL for none */
    size_t count;              /* bricks that are nowhere yet: for a few bytes each call costs too much */
    uint32_t at[BLOCK][3];
    uint64_t bits[BLOCK][8], inside[BLOCK][8];
} npz;

static void drop_npz(brick_out *out)
{
    npz *const z = out->state;
    for (int array = 0; array < NPZ_ORIGIN; array++)
        if (z->waiting[array])
            fclose(z->waiting[array]);
    zip_free(&z->zip);
    free(z);
}

static int open_npz(brick_out *out)
{
    const bool is_waiting[NPZ_ORIGIN] = {[NPZ_AT] = true,
                                         [NPZ_IDS] = out->options.has_ids,
                                         [NPZ_INSIDE] = out->options.has_labels,
                                         [NPZ_COLOURS] = out->cells.colours};
    npz *const z = out->state = calloc(1, sizeof *z);
    int code = z && zip_begin(&z->zip, out->to, out->options.is_deflated) ? EXIT_CODE_OK
                                                                          : message_failure("%s: out of memory", out->file->path);
    for (int array = 0; array < NPZ_ORIGIN && !code; array++)
        if (is_waiting[array] && !(z->waiting[array] = spool_open(out->file)))
            code = EXIT_CODE_FAILURE;
    if (!code)
        zip_begin_member(&z->zip, &npz_arrays[NPZ_BITS].npy);
    else if (z)
        drop_npz(out);
    return code;
}

static int wait(brick_out *out, int array, const void *bytes, size_t count)
{
    const npz *const z = out->state;
    return fwrite(bytes, 1, count, z->waiting[array]) == count ? EXIT_CODE_OK : file_out_failure(out->file);
}

static int write_block(brick_out *out)
{
    npz *const z = out->state;
    const size_t count = z->count;
    z->count = 0;
    little_turn(z->bits, 8 * count, sizeof **z->bits);
    zip_add(&z->zip, z->bits, count * sizeof *z->bits);
    little_turn(z->at, 3 * count, sizeof **z->at);
    const int code = wait(out, NPZ_AT, z->at, count * sizeof *z->at);
    if (code || !out->options.has_labels)
        return code;
    little_turn(z->inside, 8 * count, sizeof **z->inside);
    return wait(out, NPZ_INSIDE, z->inside, count * sizeof *z->inside);
}

/* The ids or the colours of a brick's cells. */
static int wait_for_cells(brick_out *out, const uint32_t at[3], size_t cells)
{
    uint32_t ids[512];
    if (out->cells.colours)
        return wait(out, NPZ_COLOURS, cell_colours_of_brick(out->cells.colours, at), cells * sizeof(rgb));
    memcpy(ids, out->ids, cells * sizeof *ids);
    little_turn(ids, cells, sizeof *ids);
    out->occupied += cells;
    return wait(out, NPZ_IDS, ids, cells * sizeof *ids);
}

static int put_npz(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    npz *const z = out->state;
    int code = EXIT_CODE_OK;
    memcpy(z->at[z->count], at, sizeof *z->at);
    memcpy(z->bits[z->count], bits, sizeof *z->bits);
    if (out->options.has_labels)
        memcpy(z->inside[z->count], out->inside, sizeof *z->inside);
    if (out->cells.colours || out->options.has_ids)
        code = wait_for_cells(out, at, (size_t)voxels_count(bits, 8));
    return code || ++z->count < BLOCK ? code : write_block(out);
}

static bool add_some(void *zip, const void *bytes, size_t count)
{
    zip_add(zip, bytes, count);
    return true;
}

static int end_npz(brick_out *out, progress *bar)
{
    npz *const z = out->state;
    part_header header = {.whole.cells = out->cells};
    (void)bar;
    int code = write_block(out);
    zip_end_member(&z->zip, out->bricks);
    for (int array = NPZ_AT; array < NPZ_ORIGIN && !code; array++)
        if (z->waiting[array]) {
            zip_begin_member(&z->zip, &npz_arrays[array].npy);
            code = spool_read(z->waiting[array], out->file, add_some, &z->zip);
            zip_end_member(&z->zip, array == NPZ_IDS       ? out->occupied
                                    : array == NPZ_COLOURS ? out->cells.colours->cells
                                                           : out->bricks);
        }
    if (code)
        return code;
    add_about(&z->zip, out->part ? out->part : &header);
    zip_end(&z->zip);
    return EXIT_CODE_OK;
}

const volume_writer volume_npz = {.goes_back = true, .open = open_npz, .put = put_npz, .end = end_npz, .drop = drop_npz};
