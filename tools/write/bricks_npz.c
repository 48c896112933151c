/* bricks_npz.c - bricks as arrays for numpy.load: where they are, their bits, what is known of these, and the grid. */
#define _POSIX_C_SOURCE 200809L
#include "npz.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "brick_out.h"
#include "colours/colours.h"
#include "console/system.h"
#include "console/message.h"
#include "read/little.h"

/* ----------------------------------------------------------------------------------------------------------------------- arrays */

const npz_array npz_arrays[NPZ_END] = {
    [NPZ_BITS] = {"bits.npy", "<u8", 8, 64, 0},      [NPZ_AT] = {"at.npy", "<u4", 3, 12, 0},
    [NPZ_IDS] = {"ids.npy", "<u4", 0, 4, 0},         [NPZ_INSIDE] = {"inside.npy", "<u8", 8, 64, 0},
    [NPZ_COLOURS] = {"colours.npy", "|u1", 3, 3, 0}, [NPZ_ORIGIN] = {"origin.npy", "<f8", 0, 8, 3},
    [NPZ_CELL] = {"cell.npy", "<f8", 0, 8, 3},       [NPZ_SIZE] = {"size.npy", "<u4", 0, 4, 3},
    [NPZ_SHIFT] = {"shift.npy", "<f8", 0, 8, 3},     [NPZ_SHARD] = {"shard.npy", "<u4", 0, 4, 2},
    [NPZ_TILES] = {"tiles.npy", "<u8", 0, 8, 2},     [NPZ_WHOLE] = {"whole.npy", "<u8", 0, 8, NPZ_NUMBERS_MOST},
};

void npz_header(unsigned char header[NPY_HEADER], int array, uint64_t rows)
{
    char shape[32];
    const npz_array *const a = &npz_arrays[array];
    if (a->columns)
        snprintf(shape, sizeof shape, "(%" PRIu64 ", %d)", rows, a->columns);
    else
        snprintf(shape, sizeof shape, "(%" PRIu64 ",)", rows);
    npy_header(header, a->type, shape);
}

static void tell_about(npz_about *about, const voxels *v, const part_header *of)
{
    memcpy(about->of[NPZ_ORIGIN], v->grid.origin, sizeof v->grid.origin);
    memcpy(about->of[NPZ_CELL], v->grid.cell, sizeof v->grid.cell);
    memcpy(about->of[NPZ_SHIFT], v->shift, sizeof v->shift);
    for (int a = 0; a < 3; a++)
        about->of[NPZ_SIZE][a] = v->grid.size[a];
    if (!of)
        return;
    const part_whole *const w = &of->whole;
    const uint64_t shard[] = {of->shard, w->shards}, tiles[] = {of->from, of->to};
    const uint64_t whole[] = {w->triangles, w->sums.coordinates, w->sums.order, w->position_bytes, w->accuracy, w->axes, w->tile};
    memcpy(about->of[NPZ_SHARD], shard, sizeof shard);
    memcpy(about->of[NPZ_TILES], tiles, sizeof tiles);
    memcpy(about->of[NPZ_WHOLE], whole, sizeof whole);
}

void npz_add_about(zip_out *zip, const voxels *v, const part_header *of)
{
    npz_about about;
    tell_about(&about, v, of);
    for (int array = NPZ_ORIGIN; array < (of ? NPZ_END : NPZ_SHARD); array++) {
        unsigned char header[NPY_HEADER], bytes[8 * NPZ_NUMBERS_MOST];
        const npz_array *const a = &npz_arrays[array];
        for (unsigned n = 0; n < a->rows; n++)
            if (a->row_bytes == 4)
                little_put32(bytes + 4 * n, (uint32_t)about.of[array][n]);
            else
                little_put64(bytes + 8 * n, about.of[array][n]);
        zip_begin_member(zip, a->name);
        zip_add(zip, bytes, a->rows * (size_t)a->row_bytes);
        npz_header(header, array, a->rows);
        zip_end_member(zip, header);
    }
}

bool npz_take_about(part_header *to, const npz_about *about)
{
    part_whole *const w = &to->whole;
    const uint64_t *const whole = about->of[NPZ_WHOLE];
    memcpy(w->cells.grid.origin, about->of[NPZ_ORIGIN], sizeof w->cells.grid.origin);
    memcpy(w->cells.grid.cell, about->of[NPZ_CELL], sizeof w->cells.grid.cell);
    memcpy(w->cells.shift, about->of[NPZ_SHIFT], sizeof w->cells.shift);
    for (int a = 0; a < 3; a++)
        w->cells.grid.size[a] = (uint32_t)about->of[NPZ_SIZE][a];
    to->shard = (uint32_t)about->of[NPZ_SHARD][0];
    w->shards = (uint32_t)about->of[NPZ_SHARD][1];
    to->from = about->of[NPZ_TILES][0];
    to->to = about->of[NPZ_TILES][1];
    w->triangles = whole[0];
    w->sums = (mesh_sums){whole[1], whole[2]};
    w->position_bytes = (uint32_t)whole[3];
    w->accuracy = (uint32_t)whole[4];
    w->axes = (uint32_t)whole[5];
    w->tile = (uint32_t)whole[6];
    return whole[3] <= UINT32_MAX && whole[4] <= UINT32_MAX && whole[5] <= UINT32_MAX && whole[6] <= UINT32_MAX;
}

/* ----------------------------------------------------------------------------------------------------------------------- bricks */

enum { AT_BYTES = 12, BITS_BYTES = 64, BLOCK = 512, KEPT = 1 << 22, CHUNK = 1 << 16 };

/* Bytes that cannot go where they belong yet: in memory, which takes less than a file, as long as they are few. */
typedef struct waiting {
    const file_out *out;  /* where they will go, for the place of the file and for messages */
    unsigned char *bytes; /* NULL for none */
    size_t count, room;   /* of these, and for how many there is memory */
    FILE *rest;           /* NULL as long as there is none */
} waiting;

static waiting waiting_for(const file_out *out) { return (waiting){.out = out}; }

static void waiting_free(waiting *w)
{
    if (w->rest)
        fclose(w->rest);
    pages_free(w->bytes, w->room);
    *w = (waiting){.count = 0};
}

/* Returns an exit_code, on failure after its line. */
static int waiting_add(waiting *w, const void *bytes, size_t count)
{
    void *const grown = !w->rest && count <= KEPT - w->count ? memory_grow_pages(w->bytes, w->count + count, &w->room, 1) : NULL;
    if (grown) {
        w->bytes = grown;
        memcpy(w->bytes + w->count, bytes, count);
        w->count += count;
        return EXIT_CODE_OK;
    }
    if (!w->rest)
        w->rest = spool_open(w->out);
    if (!w->rest)
        return EXIT_CODE_FAILURE;
    return fwrite(bytes, 1, count, w->rest) == count ? EXIT_CODE_OK : file_out_failure(w->out);
}

/* Hands on all of them, in order. Returns as above. */
static int waiting_hand_on(waiting *w, void (*take)(void *data, const void *bytes, size_t count), void *data)
{
    unsigned char chunk[CHUNK];
    size_t length;
    if (w->count)
        take(data, w->bytes, w->count);
    if (!w->rest)
        return EXIT_CODE_OK;
    if (fflush(w->rest) || fseek(w->rest, 0, SEEK_SET))
        return file_out_failure(w->out);
    while ((length = fread(chunk, 1, sizeof chunk, w->rest)) > 0)
        take(data, chunk, length);
    return ferror(w->rest) ? file_out_failure(w->out) : EXIT_CODE_OK;
}

/* The file gets the bits as they come; what else there is of bricks and cells waits beside it. */
typedef struct npz {
    zip_out zip;
    waiting places, colours, insides, ids; /* all but the first where there are some */
    uint64_t cells;                        /* that have ids */
    size_t count;                          /* bricks that are in none yet: for a few bytes each call costs too much */
    unsigned char place[BLOCK][AT_BYTES], words[BLOCK][BITS_BYTES], inside[BLOCK][BITS_BYTES];
} npz;

static void free_npz(npz *z)
{
    waiting_free(&z->places);
    waiting_free(&z->colours);
    waiting_free(&z->insides);
    waiting_free(&z->ids);
    zip_free(&z->zip);
    free(z);
}

static int open_npz(brick_out *out)
{
    npz *const z = calloc(1, sizeof *z);
    if (!z)
        return message_failure("%s: out of memory", out->file->path);
    z->places = waiting_for(out->file);
    z->colours = out->cells.colours ? waiting_for(out->file) : (waiting){.count = 0};
    z->insides = out->options.has_labels ? waiting_for(out->file) : (waiting){.count = 0};
    z->ids = out->options.has_ids ? waiting_for(out->file) : (waiting){.count = 0};
    if (!zip_begin(&z->zip, out->to, out->options.is_deflated)) {
        free_npz(z);
        return message_failure("%s: out of memory", out->file->path);
    }
    zip_begin_member(&z->zip, npz_arrays[NPZ_BITS].name);
    out->state = z;
    return EXIT_CODE_OK;
}

static int write_block(brick_out *out)
{
    npz *const z = out->state;
    const size_t count = z->count;
    z->count = 0;
    zip_add(&z->zip, z->words, count * BITS_BYTES);
    const int code = waiting_add(&z->places, z->place, count * AT_BYTES);
    return code || !out->options.has_labels ? code : waiting_add(&z->insides, z->inside, count * BITS_BYTES);
}

static int put_colours(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    npz *const z = out->state;
    return waiting_add(&z->colours, cell_colours_of_brick(out->cells.colours, at), (size_t)voxels_count(bits, 8) * sizeof(rgb));
}

static int put_ids(brick_out *out, const uint64_t bits[8])
{
    npz *const z = out->state;
    unsigned char bytes[4 * 512];
    const size_t cells = (size_t)voxels_count(bits, 8);
    for (size_t n = 0; n < cells; n++)
        little_put32(bytes + 4 * n, out->ids[n]);
    z->cells += cells;
    return waiting_add(&z->ids, bytes, 4 * cells);
}

static void put_words(unsigned char *to, const uint64_t words[8])
{
    for (int k = 0; k < 8; k++)
        little_put64(to + 8 * k, words[k]);
}

static int put_npz(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    npz *const z = out->state;
    for (int a = 0; a < 3; a++)
        little_put32(z->place[z->count] + 4 * a, at[a]);
    put_words(z->words[z->count], bits);
    if (out->options.has_labels)
        put_words(z->inside[z->count], out->inside);
    const int code = out->cells.colours ? put_colours(out, at, bits) : out->options.has_ids ? put_ids(out, bits) : EXIT_CODE_OK;
    return code || ++z->count < BLOCK ? code : write_block(out);
}

static void end_rows(npz *z, int array, uint64_t rows)
{
    unsigned char header[NPY_HEADER];
    npz_header(header, array, rows);
    zip_end_member(&z->zip, header);
}

static void add_some(void *zip, const void *bytes, size_t count) { zip_add(zip, bytes, count); }

/* What waited beside the file. */
static int add_waited(npz *z, waiting *from, int array, uint64_t rows)
{
    zip_begin_member(&z->zip, npz_arrays[array].name);
    const int code = waiting_hand_on(from, add_some, &z->zip);
    if (!code)
        end_rows(z, array, rows);
    return code;
}

static int end_npz(brick_out *out, progress *bar)
{
    npz *const z = out->state;
    (void)bar;
    int code = write_block(out);
    if (code)
        return code;
    end_rows(z, NPZ_BITS, out->bricks);
    code = add_waited(z, &z->places, NPZ_AT, out->bricks);
    if (!code && out->options.has_labels)
        code = add_waited(z, &z->insides, NPZ_INSIDE, out->bricks);
    if (!code && out->cells.colours)
        code = add_waited(z, &z->colours, NPZ_COLOURS, out->cells.colours->cells);
    if (!code && out->options.has_ids)
        code = add_waited(z, &z->ids, NPZ_IDS, z->cells);
    if (code)
        return code;
    npz_add_about(&z->zip, &out->cells, out->part);
    zip_end(&z->zip);
    return EXIT_CODE_OK;
}

static void drop_npz(brick_out *out) { free_npz(out->state); }

static const brick_writer bricks = {.goes_back = true, .open = open_npz, .put = put_npz, .end = end_npz, .drop = drop_npz};

const volume_writer volume_npz = {.bricks = &bricks};
