/* zip_out.c - the format of .zip files: https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT */
#define _POSIX_C_SOURCE 200809L
#include "zip_out.h"

#include <string.h>
#include <zlib.h>

#include "read/little.h"

/* Sizes that do not fit stand in an extra field; before a member they always do, as they are not known yet. */
enum {
    STORED = 0,
    DEFLATED = 8,
    VERSION = 45, /* of the extra field */
    DAY = 0x21,   /* 1 January 1980, so that equal content gives equal files */
    EXTRA = 1,
    BEFORE_MAX = 30 + ZIP_NAME_MAX + 20,
    LISTED_MAX = 46 + ZIP_NAME_MAX + 28,
    END = 56 + 20 + 22,
    BLOCK = 5 /* the header of stored bytes in a deflated stream */
};
static const uint32_t none = UINT32_MAX;

/* Fields one after the other. */
typedef struct fields {
    unsigned char *at;
} fields;

static void put16(fields *f, unsigned number)
{
    *f->at++ = (unsigned char)number;
    *f->at++ = (unsigned char)(number >> 8);
}

static void put32(fields *f, uint32_t number)
{
    little_put32(f->at, number);
    f->at += 4;
}

static void put64(fields *f, uint64_t number)
{
    little_put64(f->at, number);
    f->at += 8;
}

static void put_name(fields *f, const char *name)
{
    memcpy(f->at, name, strlen(name));
    f->at += strlen(name);
}

static bool is_long(uint64_t number) { return number >= none; }

static uint32_t or_none(uint64_t number) { return is_long(number) ? none : (uint32_t)number; }

static void write_fields(zip_out *zip, const unsigned char *bytes, const fields *end)
{
    zip->written += fwrite(bytes, 1, (size_t)(end->at - bytes), zip->to);
}

/* What both headers of a member have in common. */
static void put_common(const zip_out *zip, fields *f, const zip_member *m)
{
    put16(f, VERSION);
    put16(f, 0);
    put16(f, zip->deflater ? DEFLATED : STORED);
    put16(f, 0);
    put16(f, DAY);
    put32(f, m->crc);
}

static void write_before(zip_out *zip, const zip_member *m)
{
    unsigned char bytes[BEFORE_MAX];
    fields f = {bytes};
    put32(&f, 0x04034b50);
    put_common(zip, &f, m);
    put32(&f, none);
    put32(&f, none);
    put16(&f, (unsigned)strlen(m->name));
    put16(&f, 20);
    put_name(&f, m->name);
    put16(&f, EXTRA);
    put16(&f, 16);
    put64(&f, m->bytes);
    put64(&f, m->stored);
    write_fields(zip, bytes, &f);
}

static void write_header(zip_out *zip, const unsigned char header[NPY_HEADER])
{
    static const unsigned char block[BLOCK] = {0, NPY_HEADER, 0, 0xff - NPY_HEADER, 0xff};
    if (zip->deflater)
        zip->written += fwrite(block, 1, sizeof block, zip->to);
    zip->written += fwrite(header, 1, NPY_HEADER, zip->to);
}

void zip_begin(zip_out *zip, FILE *to, deflater *by) { *zip = (zip_out){.to = to, .deflater = by}; }

void zip_begin_member(zip_out *zip, const char *name)
{
    static const unsigned char unknown[NPY_HEADER];
    zip_member *const m = &zip->members[zip->count++];
    *m = (zip_member){.start = zip->written};
    strncpy(m->name, name, ZIP_NAME_MAX);
    write_before(zip, m);
    write_header(zip, unknown);
    if (zip->deflater)
        deflater_restart(zip->deflater);
}

void zip_add(zip_out *zip, const void *bytes, size_t count)
{
    zip_member *const m = &zip->members[zip->count - 1];
    m->crc = (uint32_t)crc32_z(m->crc, bytes, count);
    m->bytes += count;
    zip->written += zip->deflater ? deflater_add(zip->deflater, bytes, count, zip->to) : fwrite(bytes, 1, count, zip->to);
}

void zip_skip(zip_out *zip, uint64_t bytes)
{
    zip->members[zip->count - 1].bytes += bytes;
    zip->written += bytes;
    fseeko(zip->to, (off_t)zip->written, SEEK_SET);
}

uint32_t zip_crc(uint32_t crc, const void *bytes, size_t count) { return (uint32_t)crc32_z(crc, bytes, count); }

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
uint32_t zip_crc_of_both(uint32_t first, uint32_t second, uint64_t bytes)
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
        zip->written += deflater_end(zip->deflater, zip->to);
    m->crc = zip_crc_of_both((uint32_t)crc32_z(0, header, NPY_HEADER), m->crc, m->bytes);
    m->bytes += NPY_HEADER;
    m->stored = zip->written - m->start - (30 + strlen(m->name) + 20);
    fill_in(zip, m, header);
}

void zip_set_crc(zip_out *zip, unsigned number, const unsigned char header[NPY_HEADER], uint32_t crc, uint64_t bytes)
{
    zip_member *const m = &zip->members[number];
    m->crc = zip_crc_of_both(zip_crc(0, header, NPY_HEADER), crc, bytes);
    fill_in(zip, m, header);
}

static void list_member(zip_out *zip, const zip_member *m)
{
    unsigned char bytes[LISTED_MAX];
    fields f = {bytes};
    const bool is_extra = is_long(m->bytes) || is_long(m->stored) || is_long(m->start);
    put32(&f, 0x02014b50);
    put16(&f, VERSION);
    put_common(zip, &f, m);
    put32(&f, is_extra ? none : (uint32_t)m->stored);
    put32(&f, is_extra ? none : (uint32_t)m->bytes);
    put16(&f, (unsigned)strlen(m->name));
    put16(&f, is_extra ? 28 : 0);
    put16(&f, 0);
    put32(&f, 0);
    put32(&f, 0);
    put32(&f, is_extra ? none : (uint32_t)m->start);
    put_name(&f, m->name);
    if (is_extra) {
        put16(&f, EXTRA);
        put16(&f, 24);
        put64(&f, m->bytes);
        put64(&f, m->stored);
        put64(&f, m->start);
    }
    write_fields(zip, bytes, &f);
}

static void put_long_end(fields *f, const zip_out *zip, uint64_t list)
{
    put32(f, 0x06064b50);
    put64(f, 44);
    put16(f, VERSION);
    put16(f, VERSION);
    put32(f, 0);
    put32(f, 0);
    put64(f, zip->count);
    put64(f, zip->count);
    put64(f, zip->written - list);
    put64(f, list);
    put32(f, 0x07064b50);
    put32(f, 0);
    put64(f, zip->written);
    put32(f, 1);
}

void zip_end(zip_out *zip)
{
    unsigned char bytes[END];
    fields f = {bytes};
    const uint64_t list = zip->written;
    for (unsigned i = 0; i < zip->count; i++)
        list_member(zip, &zip->members[i]);
    if (is_long(list))
        put_long_end(&f, zip, list);
    put32(&f, 0x06054b50);
    put16(&f, 0);
    put16(&f, 0);
    put16(&f, zip->count);
    put16(&f, zip->count);
    put32(&f, (uint32_t)(zip->written - list));
    put32(&f, or_none(list));
    put16(&f, 0);
    write_fields(zip, bytes, &f);
}
