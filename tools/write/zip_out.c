/* zip_out.c - the format of .zip files: https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT */
#define _POSIX_C_SOURCE 200809L
#define ZLIB_CONST
#include "zip.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* Sizes that do not fit stand in an extra field; before a member they always do, as they are not known yet. */
enum {
    STORED = 0,
    DEFLATED = 8,
    VERSION = 45, /* of the extra field */
    DAY = 0x21,   /* 1 January 1980, so that equal content gives equal files */
    EXTRA = 1,
    BLOCK = 5, /* the header of stored bytes in a deflated stream */
    CHUNK = 1 << 16,
    LEVEL = 4,
    MEMORY_LEVEL = 9
};
static const uint32_t none = UINT32_MAX;

struct deflater {
    z_stream stream;
    unsigned char out[CHUNK];
};

bool zip_begin(zip_out *zip, FILE *to, bool is_deflated)
{
    struct deflater *const d = is_deflated ? calloc(1, sizeof *d) : NULL;
    *zip = (zip_out){.to = to};
    if (d && !deflateInit2(&d->stream, LEVEL, Z_DEFLATED, -MAX_WBITS, MEMORY_LEVEL, Z_DEFAULT_STRATEGY))
        zip->deflater = d;
    else
        free(d);
    return zip->deflater || !is_deflated;
}

void zip_free(zip_out *zip)
{
    if (zip->deflater)
        deflateEnd(&zip->deflater->stream);
    free(zip->deflater);
    zip->deflater = NULL;
}

/* Writes what comes out of these bytes, and, to finish, what is left. */
static void deflate_bytes(zip_out *zip, const void *bytes, size_t count, int flush)
{
    struct deflater *const d = zip->deflater;
    d->stream.next_in = bytes;
    d->stream.avail_in = (uInt)count;
    do {
        d->stream.next_out = d->out;
        d->stream.avail_out = CHUNK;
        deflate(&d->stream, flush);
        const size_t filled = CHUNK - d->stream.avail_out;
        fwrite(d->out, 1, filled, zip->to);
        zip->written += filled;
    } while (!d->stream.avail_out);
}

static void write_bytes(zip_out *zip, const void *bytes, size_t count) { zip->written += fwrite(bytes, 1, count, zip->to); }

/* A number in so many bytes. */
typedef struct field {
    unsigned bytes;
    uint64_t number;
} field;

/* One after the other, up to one of no bytes. */
static void write_fields(zip_out *zip, const field *f)
{
    unsigned char bytes[128];
    size_t count = 0;
    for (; f->bytes; f++)
        for (unsigned b = 0; b < f->bytes; b++)
            bytes[count++] = (unsigned char)(f->number >> 8 * b);
    write_bytes(zip, bytes, count);
}

static bool is_long(uint64_t number) { return number >= none; }

static uint32_t or_none(uint64_t number) { return is_long(number) ? none : (uint32_t)number; }

/* What both headers of a member have in common. */
#define COMMON(zip, m) \
    {2, VERSION}, {2, 0}, {2, (zip)->deflater ? DEFLATED : STORED}, {2, 0}, {2, DAY}, { 4, (m)->crc }

static void write_before(zip_out *zip, const zip_member *m)
{
    const size_t name = strlen(m->name);
    write_fields(zip, (const field[]){{4, 0x04034b50}, COMMON(zip, m), {4, none}, {4, none}, {2, name}, {2, 20}, {0, 0}});
    write_bytes(zip, m->name, name);
    write_fields(zip, (const field[]){{2, EXTRA}, {2, 16}, {8, m->bytes}, {8, m->stored}, {0, 0}});
}

static void write_header(zip_out *zip, const unsigned char header[NPY_HEADER])
{
    static const unsigned char block[BLOCK] = {0, NPY_HEADER, 0, 0xff - NPY_HEADER, 0xff};
    if (zip->deflater)
        write_bytes(zip, block, sizeof block);
    write_bytes(zip, header, NPY_HEADER);
}

void zip_begin_member(zip_out *zip, const char *name)
{
    static const unsigned char unknown[NPY_HEADER];
    zip_member *const m = &zip->members[zip->count++];
    *m = (zip_member){.start = zip->written};
    strncpy(m->name, name, ZIP_NAME_MAX);
    write_before(zip, m);
    write_header(zip, unknown);
    if (zip->deflater)
        deflateReset(&zip->deflater->stream);
}

void zip_add(zip_out *zip, const void *bytes, size_t count)
{
    zip_member *const m = &zip->members[zip->count - 1];
    m->crc = (uint32_t)crc32_z(m->crc, bytes, count);
    m->bytes += count;
    if (zip->deflater)
        deflate_bytes(zip, bytes, count, Z_NO_FLUSH);
    else
        write_bytes(zip, bytes, count);
}

/* Writes again what stands before a member's bytes. */
static void fill_in(zip_out *zip, const zip_member *m, const unsigned char header[NPY_HEADER])
{
    const uint64_t end = zip->written;
    if (!fseeko(zip->to, (off_t)m->start, SEEK_SET)) {
        write_before(zip, m);
        write_header(zip, header);
        fseeko(zip->to, (off_t)end, SEEK_SET);
    }
    zip->written = end;
}

/* zlib takes the length as a long at times. */
static uint32_t crc_of_both(uint32_t first, uint32_t second, uint64_t bytes)
{
    const uint64_t step = (uint64_t)1 << 30;
    for (; bytes > step; bytes -= step)
        first = (uint32_t)crc32_combine(first, 0, (z_off_t)step);
    return (uint32_t)crc32_combine(first, second, (z_off_t)bytes);
}

void zip_end_member(zip_out *zip, const unsigned char header[NPY_HEADER])
{
    zip_member *const m = &zip->members[zip->count - 1];
    if (zip->deflater)
        deflate_bytes(zip, NULL, 0, Z_FINISH);
    m->crc = crc_of_both((uint32_t)crc32_z(0, header, NPY_HEADER), m->crc, m->bytes);
    m->bytes += NPY_HEADER;
    m->stored = zip->written - m->start - (30 + strlen(m->name) + 20);
    fill_in(zip, m, header);
}

static void list_member(zip_out *zip, const zip_member *m)
{
    const size_t name = strlen(m->name);
    const bool is_extra = is_long(m->bytes) || is_long(m->stored) || is_long(m->start);
    write_fields(zip, (const field[]){{4, 0x02014b50},
                                      {2, VERSION},
                                      COMMON(zip, m),
                                      {4, is_extra ? none : m->stored},
                                      {4, is_extra ? none : m->bytes},
                                      {2, name},
                                      {2, is_extra ? 28 : 0},
                                      {2, 0},
                                      {8, 0}, /* where it begins and what it is, of several disks and systems */
                                      {4, is_extra ? none : m->start},
                                      {0, 0}});
    write_bytes(zip, m->name, name);
    if (is_extra)
        write_fields(zip, (const field[]){{2, EXTRA}, {2, 24}, {8, m->bytes}, {8, m->stored}, {8, m->start}, {0, 0}});
}

/* Of a list beyond what 32 bits hold, and where that end begins. */
static void write_long_end(zip_out *zip, uint64_t list, uint64_t bytes)
{
    const uint64_t end = zip->written;
    write_fields(zip, (const field[]){{4, 0x06064b50},
                                      {8, 44},
                                      {2, VERSION},
                                      {2, VERSION},
                                      {8, 0},
                                      {8, zip->count},
                                      {8, zip->count},
                                      {8, bytes},
                                      {8, list},
                                      {0, 0}});
    write_fields(zip, (const field[]){{4, 0x07064b50}, {4, 0}, {8, end}, {4, 1}, {0, 0}});
}

void zip_end(zip_out *zip)
{
    const uint64_t list = zip->written;
    for (unsigned i = 0; i < zip->count; i++)
        list_member(zip, &zip->members[i]);
    const uint64_t bytes = zip->written - list;
    if (is_long(list))
        write_long_end(zip, list, bytes);
    write_fields(
        zip,
        (const field[]){{4, 0x06054b50}, {4, 0}, {2, zip->count}, {2, zip->count}, {4, bytes}, {4, or_none(list)}, {2, 0}, {0, 0}});
}
