/* bricks_npz.c - bricks as arrays for numpy.load: where they are, their bits, and the grid. */
#include <stdlib.h>
#include <string.h>

#include "brick_writer.h"
#include "console/message.h"
#include "npz_members.h"
#include "read/little.h"
#include "spool.h"

enum { AT_BYTES = 12, BITS_BYTES = 64, BLOCK = 512, CHUNK = 1 << 16 };

/* The file gets the bits as they come; the places wait beside it. */
typedef struct npz {
    zip_out zip;
    FILE *places;
    deflater *deflater; /* NULL: not deflated */
    size_t waiting;     /* bricks that are in neither yet: for a few bytes each call costs too much */
    unsigned char place[BLOCK][AT_BYTES], words[BLOCK][BITS_BYTES];
} npz;

static void free_npz(npz *z)
{
    if (z->places)
        fclose(z->places);
    deflater_free(z->deflater);
    free(z);
}

static int open_npz(brick_out *out)
{
    npz *const z = calloc(1, sizeof *z);
    if (!z)
        return message_failure("%s: out of memory", out->file->path);
    z->deflater = out->options.is_deflated ? deflater_new() : NULL;
    z->places = spool_open(out->file);
    const bool lacks_memory = out->options.is_deflated && !z->deflater;
    if (lacks_memory || !z->places) {
        free_npz(z);
        return lacks_memory ? message_failure("%s: out of memory", out->file->path) : EXIT_CODE_FAILURE;
    }
    zip_begin(&z->zip, out->to, z->deflater);
    zip_begin_member(&z->zip, "bits.npy");
    out->state = z;
    return EXIT_CODE_OK;
}

static int write_waiting(brick_out *out)
{
    npz *const z = out->state;
    fwrite(z->place, AT_BYTES, z->waiting, z->places);
    zip_add(&z->zip, z->words, z->waiting * BITS_BYTES);
    z->waiting = 0;
    return !ferror(z->places) ? EXIT_CODE_OK : file_out_failure(out->file);
}

static int put_npz(brick_out *out, const uint32_t at[3], const uint64_t bits[8])
{
    npz *const z = out->state;
    for (int a = 0; a < 3; a++)
        little_put32(z->place[z->waiting] + 4 * a, at[a]);
    for (int k = 0; k < 8; k++)
        little_put64(z->words[z->waiting] + 8 * k, bits[k]);
    return ++z->waiting < BLOCK ? EXIT_CODE_OK : write_waiting(out);
}

static void end_rows(brick_out *out, const char *type, int columns)
{
    npz *const z = out->state;
    unsigned char header[NPY_HEADER];
    npz_rows(header, type, out->bricks, columns);
    zip_end_member(&z->zip, header);
}

static int add_places(brick_out *out)
{
    npz *const z = out->state;
    unsigned char chunk[CHUNK];
    size_t length;
    if (fflush(z->places) || fseek(z->places, 0, SEEK_SET))
        return file_out_failure(out->file);
    zip_begin_member(&z->zip, "at.npy");
    while ((length = fread(chunk, 1, sizeof chunk, z->places)) > 0)
        zip_add(&z->zip, chunk, length);
    end_rows(out, "<u4", 3);
    return !ferror(z->places) ? EXIT_CODE_OK : file_out_failure(out->file);
}

static int end_npz(brick_out *out, progress *bar)
{
    npz *const z = out->state;
    (void)bar;
    int code = write_waiting(out);
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
