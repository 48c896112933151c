/* zip_in.c - reads what zip_out.c writes, and what NumPy makes of it. */
#define _POSIX_C_SOURCE 200809L
#include "zip.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "read/little.h"

enum {
    STORED = 0,
    DEFLATED = 8,
    EXTRA = 1, /* the field of sizes that do not fit */
    BEFORE = 30,
    LISTED = 46,
    END = 22,
    LONG_END = 56,
    LOCATOR = 20,
    LIST_MOST = 4096,
    RATIO_MOST = 1040, /* a deflated byte stands for 1032 at most */
    ROOM = 1 << 16
};

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

typedef struct inflater {
    z_stream stream;
    unsigned char room[ROOM];
} inflater;

bool zip_reader_open(zip_reader *r, FILE *from, const zip_member *of)
{
    *r = (zip_reader){.from = from, .of = of, .at = of->start, .stored = of->stored, .left = of->bytes};
    if (!of->is_deflated)
        return true;
    r->inflater = calloc(1, sizeof *r->inflater);
    if (r->inflater && inflateInit2(&r->inflater->stream, -MAX_WBITS) == Z_OK)
        return true;
    free(r->inflater);
    r->inflater = NULL;
    return false;
}

static bool inflate_some(zip_reader *r, void *to, size_t bytes)
{
    z_stream *const z = &r->inflater->stream;
    z->next_out = to;
    z->avail_out = (uInt)bytes;
    while (z->avail_out) {
        if (!z->avail_in) {
            const size_t some = r->stored < ROOM ? (size_t)r->stored : ROOM;
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
    r->crc = (uint32_t)crc32_z(r->crc, to, bytes);
    return true;
}

bool zip_reader_is_whole(const zip_reader *r) { return !r->left && r->crc == r->of->crc; }

void zip_reader_close(zip_reader *r)
{
    if (r->inflater)
        inflateEnd(&r->inflater->stream);
    free(r->inflater);
    r->inflater = NULL;
}
