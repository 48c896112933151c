/* zip.c - the format of .zip files: https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT; and what NumPy makes of it. */
#define _POSIX_C_SOURCE 200809L
#define ZLIB_CONST
#include "zip.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "read/little.h"

/* Sizes that do not fit stand in an extra field; before a member they always do, as they are not known yet. */
enum {
    STORED = 0,
    DEFLATED = 8,
    VERSION = 45, /* of the extra field */
    DAY = 0x21,   /* 1 January 1980, so that equal content gives equal files */
    EXTRA = 1,    /* the field of sizes that do not fit */
    LOCAL_EXTRA = 20,
    BEFORE = 30, /* a member, with its name and that field */
    BLOCK = 5,   /* the header of stored bytes in a deflated stream */
    CHUNK = 1 << 16,
    LEVEL = 4,
    MEMORY_LEVEL = 9
};
static const uint32_t none = UINT32_MAX;

/* And room for what comes out of it, or goes in. */
struct zip_stream {
    z_stream z;
    unsigned char room[CHUNK];
};

bool zip_begin(zip_out *zip, FILE *to, bool is_deflated)
{
    struct zip_stream *const d = is_deflated ? calloc(1, sizeof *d) : NULL;
    *zip = (zip_out){.to = to};
    if (d && !deflateInit2(&d->z, LEVEL, Z_DEFLATED, -MAX_WBITS, MEMORY_LEVEL, Z_DEFAULT_STRATEGY))
        zip->deflater = d;
    else
        free(d);
    return zip->deflater || !is_deflated;
}

void zip_free(zip_out *zip)
{
    if (zip->deflater)
        deflateEnd(&zip->deflater->z);
    free(zip->deflater);
    zip->deflater = NULL;
}

/* Writes what comes out of these bytes, and, to finish, what is left. */
static void deflate_bytes(zip_out *zip, const void *bytes, size_t count, int flush)
{
    struct zip_stream *const d = zip->deflater;
    d->z.next_in = bytes;
    d->z.avail_in = (uInt)count;
    do {
        d->z.next_out = d->room;
        d->z.avail_out = CHUNK;
        deflate(&d->z, flush);
        const size_t filled = CHUNK - d->z.avail_out;
        fwrite(d->room, 1, filled, zip->to);
        zip->written += filled;
    } while (!d->z.avail_out);
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

/* What both headers of a member have in common. */
#define COMMON(zip, m) \
    {2, VERSION}, {2, 0}, {2, (zip)->deflater ? DEFLATED : STORED}, {2, 0}, {2, DAY}, { 4, (m)->crc }

/* Up to the bytes of the array: the header that stands before these in the member is not deflated. */
static void write_before(zip_out *zip, const zip_member *m, const unsigned char header[NPY_HEADER])
{
    static const unsigned char block[BLOCK] = {0, NPY_HEADER, 0, 0xff - NPY_HEADER, 0xff};
    const size_t name = strlen(m->name);
    write_fields(zip, (const field[]){{4, 0x04034b50}, COMMON(zip, m), {4, none}, {4, none}, {2, name}, {2, LOCAL_EXTRA}, {0, 0}});
    write_bytes(zip, m->name, name);
    write_fields(zip, (const field[]){{2, EXTRA}, {2, LOCAL_EXTRA - 4}, {8, m->bytes}, {8, m->stored}, {0, 0}});
    write_bytes(zip, block, zip->deflater ? sizeof block : 0);
    write_bytes(zip, header, NPY_HEADER);
}

void zip_begin_member(zip_out *zip, const npy_array *array)
{
    static const unsigned char unknown[NPY_HEADER];
    zip_member *const m = &zip->members[zip->count++];
    *m = (zip_member){.start = zip->written};
    strncpy(m->name, array->name, ZIP_NAME_MAX);
    zip->array = array;
    write_before(zip, m, unknown);
    if (zip->deflater)
        deflateReset(&zip->deflater->z);
}

void zip_add(zip_out *zip, const void *bytes, size_t count)
{
    zip_member *const m = &zip->members[zip->count - 1];
    m->crc = zip_crc(m->crc, bytes, count);
    m->bytes += count;
    if (zip->deflater)
        deflate_bytes(zip, bytes, count, Z_NO_FLUSH);
    else
        write_bytes(zip, bytes, count);
}

uint32_t zip_crc(uint32_t crc, const void *bytes, size_t count) { return (uint32_t)crc32_z(crc, bytes, count); }

/* zlib takes the length as a long at times. */
static uint32_t crc_of_both(uint32_t first, uint32_t second, uint64_t bytes)
{
    const uint64_t step = (uint64_t)1 << 30;
    for (; bytes > step; bytes -= step)
        first = (uint32_t)crc32_combine(first, 0, (z_off_t)step);
    return (uint32_t)crc32_combine(first, second, (z_off_t)bytes);
}

/* Writes again what stands before the bytes, as it is known now. */
void zip_end_member(zip_out *zip, uint64_t rows)
{
    unsigned char header[NPY_HEADER];
    zip_member *const m = &zip->members[zip->count - 1];
    if (zip->deflater)
        deflate_bytes(zip, NULL, 0, Z_FINISH);
    const uint64_t end = zip->written;
    npy_header(header, zip->array, rows);
    m->crc = crc_of_both(zip_crc(0, header, NPY_HEADER), m->crc, m->bytes);
    m->bytes += NPY_HEADER;
    m->stored = end - m->start - (BEFORE + strlen(m->name) + LOCAL_EXTRA);
    if (!fseeko(zip->to, (off_t)m->start, SEEK_SET)) {
        write_before(zip, m, header);
        fseeko(zip->to, (off_t)end, SEEK_SET);
    }
    zip->written = end;
}

void zip_add_array(zip_out *zip, const npy_array *array, size_t rows, const void *bytes)
{
    zip_begin_member(zip, array);
    zip_add(zip, bytes, rows * array->row_bytes);
    zip_end_member(zip, rows);
}

static void list_member(zip_out *zip, const zip_member *m)
{
    const size_t name = strlen(m->name);
    const bool is_extra = is_long(m->bytes) || is_long(m->stored) || is_long(m->start);
    const uint64_t bytes = is_extra ? none : m->bytes, stored = is_extra ? none : m->stored, start = is_extra ? none : m->start;
    write_fields(zip, (const field[]){{4, 0x02014b50}, {2, VERSION}, COMMON(zip, m), {4, stored}, {4, bytes}, {2, name}, {0, 0}});
    write_fields(zip, (const field[]){{2, is_extra ? 28 : 0}, {2, 0}, {8, 0}, {4, start}, {0, 0}}); /* no comment, one disk */
    write_bytes(zip, m->name, name);
    if (is_extra)
        write_fields(zip, (const field[]){{2, EXTRA}, {2, 24}, {8, m->bytes}, {8, m->stored}, {8, m->start}, {0, 0}});
}

/* Where a list is beyond what 32 bits hold another end, and where that begins, come before the one that all files have. */
void zip_end(zip_out *zip)
{
    const uint64_t list = zip->written, count = zip->count;
    for (unsigned i = 0; i < zip->count; i++)
        list_member(zip, &zip->members[i]);
    const uint64_t end = zip->written, bytes = end - list;
    if (is_long(list)) {
        write_fields(zip, (const field[]){{4, 0x06064b50}, {8, 44}, {2, VERSION}, {2, VERSION}, {8, 0}, {8, count}, {0, 0}});
        write_fields(zip, (const field[]){{8, count}, {8, bytes}, {8, list}, {4, 0x07064b50}, {4, 0}, {8, end}, {4, 1}, {0, 0}});
    }
    write_fields(zip, (const field[]){{4, 0x06054b50}, {4, 0}, {2, count}, {2, count}, {4, bytes}, {0, 0}});
    write_fields(zip, (const field[]){{4, is_long(list) ? none : list}, {2, 0}, {0, 0}});
}

/* ---------------------------------------------------------------------------------------------------------------------- reading */

/* A deflated byte stands for 1032 at most. */
enum { LISTED = 46, END = 22, LONG_END = 56, LOCATOR = 20, LIST_MOST = 4096, RATIO_MOST = 1040 };

static unsigned get16(const unsigned char *from) { return from[0] | (unsigned)from[1] << 8; }

static bool read_at(FILE *from, uint64_t at, void *to, size_t bytes)
{
    return at <= INT64_MAX && !fseeko(from, (off_t)at, SEEK_SET) && fread(to, 1, bytes, from) == bytes;
}

typedef struct list {
    uint64_t at, bytes;
    unsigned members;
} list;

static bool find_list(FILE *from, uint64_t size, list *l)
{
    unsigned char end[END], locator[LOCATOR], long_end[LONG_END];
    if (size < END || !read_at(from, size - END, end, END) || little_get32(end) != 0x06054b50)
        return false;
    *l = (list){little_get32(end + 16), little_get32(end + 12), get16(end + 10)};
    if (l->at == UINT32_MAX) {
        if (size < END + LOCATOR || !read_at(from, size - END - LOCATOR, locator, LOCATOR) || little_get32(locator) != 0x07064b50 ||
            !read_at(from, little_get64(locator + 8), long_end, LONG_END) || little_get32(long_end) != 0x06064b50)
            return false;
        l->at = little_get64(long_end + 48);
        l->bytes = little_get64(long_end + 40);
    }
    return l->bytes <= LIST_MOST && l->at <= size && l->bytes <= size - l->at;
}

/* The extra field has those numbers alone that do not fit, in this order. */
static bool widen(zip_member *m, const unsigned char *extra, size_t bytes)
{
    uint64_t *const fields[] = {&m->bytes, &m->stored, &m->start};
    while (bytes >= 4) {
        const size_t size = 4 + get16(extra + 2);
        const bool is_ours = get16(extra) == EXTRA;
        if (size > bytes)
            return false;
        for (size_t f = 0, at = 4; f < 3 && is_ours; f++)
            if (*fields[f] == UINT32_MAX && at + 8 <= size) {
                *fields[f] = little_get64(extra + at);
                at += 8;
            }
        extra += size;
        bytes -= size;
    }
    return true;
}

/* Takes a member of the list; returns how many bytes that was, 0 where it is none that is read. */
static size_t take_listed(zip_member *m, const unsigned char *at, size_t left)
{
    if (left < LISTED || little_get32(at) != 0x02014b50)
        return 0;
    const unsigned name = get16(at + 28), extra = get16(at + 30), method = get16(at + 10);
    const size_t length = LISTED + name + extra + get16(at + 32);
    if (length > left || name > ZIP_NAME_MAX || (method != STORED && method != DEFLATED))
        return 0;
    *m = (zip_member){.start = little_get32(at + 42),
                      .bytes = little_get32(at + 24),
                      .stored = little_get32(at + 20),
                      .crc = little_get32(at + 16),
                      .is_deflated = method == DEFLATED};
    memcpy(m->name, at + LISTED, name);
    return widen(m, at + LISTED + name, extra) ? length : 0;
}

/* Goes on from what stands before a member to its bytes, which end before the list. */
static bool find_bytes(zip_member *m, FILE *from, uint64_t end)
{
    unsigned char before[BEFORE];
    if (!read_at(from, m->start, before, BEFORE) || little_get32(before) != 0x04034b50)
        return false;
    m->start += BEFORE + get16(before + 26) + get16(before + 28);
    return m->start <= end && m->stored <= end - m->start &&
           (m->is_deflated ? m->bytes / RATIO_MOST <= m->stored : m->bytes == m->stored);
}

unsigned zip_in_list(FILE *from, uint64_t size, zip_member members[ZIP_MEMBERS_MAX])
{
    list l;
    unsigned char bytes[LIST_MOST];
    if (!find_list(from, size, &l) || l.members > ZIP_MEMBERS_MAX || !read_at(from, l.at, bytes, (size_t)l.bytes))
        return 0;
    size_t at = 0;
    for (unsigned i = 0; i < l.members; i++) {
        const size_t length = take_listed(&members[i], bytes + at, (size_t)l.bytes - at);
        if (!length || !find_bytes(&members[i], from, l.at))
            return 0;
        at += length;
    }
    return l.members;
}

bool zip_reader_open(zip_reader *r, FILE *from, const zip_member *of)
{
    *r = (zip_reader){.from = from, .of = of, .at = of->start, .stored = of->stored, .left = of->bytes};
    if (!of->is_deflated)
        return true;
    r->inflater = calloc(1, sizeof *r->inflater);
    if (r->inflater && inflateInit2(&r->inflater->z, -MAX_WBITS) == Z_OK)
        return true;
    free(r->inflater);
    r->inflater = NULL;
    return false;
}

static bool inflate_some(zip_reader *r, void *to, size_t bytes)
{
    z_stream *const z = &r->inflater->z;
    z->next_out = to;
    z->avail_out = (uInt)bytes;
    while (z->avail_out) {
        if (!z->avail_in) {
            const size_t some = r->stored < CHUNK ? (size_t)r->stored : CHUNK;
            if (!some || !read_at(r->from, r->at, r->inflater->room, some))
                return false;
            z->next_in = r->inflater->room;
            z->avail_in = (uInt)some;
            r->at += some;
            r->stored -= some;
        }
        const int code = inflate(z, Z_NO_FLUSH);
        if (code != Z_OK)
            return code == Z_STREAM_END && !z->avail_out;
    }
    return true;
}

bool zip_reader_read(zip_reader *r, void *to, size_t bytes)
{
    if (bytes > r->left || !(r->inflater ? inflate_some(r, to, bytes) : read_at(r->from, r->at, to, bytes)))
        return false;
    r->at += r->inflater ? 0 : bytes;
    r->left -= bytes;
    r->crc = zip_crc(r->crc, to, bytes);
    return true;
}

bool zip_reader_is_whole(const zip_reader *r) { return !r->left && r->crc == r->of->crc; }

void zip_reader_close(zip_reader *r)
{
    if (r->inflater)
        inflateEnd(&r->inflater->z);
    free(r->inflater);
    r->inflater = NULL;
}
