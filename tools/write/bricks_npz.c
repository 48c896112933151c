/* bricks_npz.c - bricks as arrays for numpy.load: where they are, their bits, and the grid. */
#include <stdlib.h>
#include <string.h>

#include "brick_writer.h"
#include "console/message.h"
#include "npz_members.h"
#include "read/little.h"
#include "waiting.h"

enum { AT_BYTES = 12, BITS_BYTES = 64, BLOCK = 512 };

/* The file gets the bits as they come; the places wait beside it. */
typedef struct npz {
    zip_out zip;
    waiting places;
    deflater *deflater; /* NULL: not deflated */
    size_t count;       /* bricks that are in neither yet: for a few bytes each call costs too much */
    unsigned char place[BLOCK][AT_BYTES], words[BLOCK][BITS_BYTES];
} npz;

static void free_npz(npz *z)
{
    waiting_free(&z->places);
    deflater_free(z->deflater);
    free(z);
}

static int open_npz(brick_out *out)
{
    npz *const z = calloc(1, sizeof *z);
    if (!z)
        return message_failure("%s: out of memory", out->file->path);
    z->deflater = out->options.is_deflated ? deflater_new() : NULL;
    z->places = waiting_for(out->file);
    if (out->options.is_deflated && !z->deflater) {
        free_npz(z);
        return message_failure("%s: out of memory", out->file->path);
    }
    zip_begin(&z->zip, out->to, z->deflater);
    zip_begin_member(&z->zip, "bits.npy");
    out->state = z;
    return EXIT_CODE_OK;
}

static int write_block(npz *z)
{
    const size_t count = z->count;
    z->count = 0;
    zip_add(&z->zip, z->words, count * BITS_BYTES);
    return waiting_add(&z->places, z->place, count * AT_BYTES);
}

static int put_npz(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    npz *const z = out->state;
    for (int a = 0; a < 3; a++)
        little_put32(z->place[z->count] + 4 * a, at[a]);
    for (int k = 0; k < 8; k++)
        little_put64(z->words[z->count] + 8 * k, bits[k]);
    return ++z->count < BLOCK ? EXIT_CODE_OK : write_block(z);
}

static void end_rows(brick_out *out, const char *type, int columns)
{
    npz *const z = out->state;
    unsigned char header[NPY_HEADER];
    npz_rows(header, type, out->bricks, columns);
    zip_end_member(&z->zip, header);
}

static void add_some(void *zip, const void *bytes, size_t count) { zip_add(zip, bytes, count); }

static int add_places(brick_out *out)
{
    npz *const z = out->state;
    zip_begin_member(&z->zip, "at.npy");
    const int code = waiting_hand_on(&z->places, add_some, &z->zip);
    if (!code)
        end_rows(out, "<u4", 3);
    return code;
}

static int end_npz(brick_out *out, progress *bar)
{
    npz *const z = out->state;
    (void)bar;
    int code = write_block(z);
    if (code)
        return code;
    end_rows(out, "<u8", 8);
    code = add_places(out);
    if (code)
        return code;
    npz_add_grid(&z->zip, &out->cells);
    if (out->part)
        npz_add_part(&z->zip, out->part);
    zip_end(&z->zip);
    return EXIT_CODE_OK;
}

int bricks_check_npz(const char *path, const tribox_grid *grid)
{
    (void)path, (void)grid;
    return EXIT_CODE_OK;
}

static void drop_npz(brick_out *out) { free_npz(out->state); }

const brick_writer bricks_npz = {.goes_back = true, .open = open_npz, .put = put_npz, .end = end_npz, .drop = drop_npz};
