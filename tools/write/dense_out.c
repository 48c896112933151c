/*
 * dense_out.c - the cells of a grid at their places in a file, with holes where none is set: spreads words to bytes, and writes the
 * blocks that have a cell; by threads, some rows each.
 */
#define _POSIX_C_SOURCE 200809L
#include "volume.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "files/files.h"
#include "read/little.h"

/*
 * A block is the least that file systems leave out. Those with a cell are written a run at a time, as long as it is: systems then
 * take pages together, three times as fast as one by one. A step takes rows of about so many bytes in the file.
 */
enum { BLOCK = 1 << 12, STEP = 1 << 18, WORD_BYTES = 64 };

typedef struct dense_out {
    FILE *to;
    const voxels *v;
    bool has_places;                   /* else the file takes bytes as they come, those of holes too */
    bool has_words;                    /* in place of a byte for each cell */
    size_t row_words, row_bytes, step; /* step: rows */
    uint64_t start, rows;              /* where in the file they begin, and how many there are */
    progress *bar;
} dense_out;

/* Of a thread: the bytes of a step, zeros where nothing has been put, and a flag for each block that is written. */
typedef struct dense_room {
    unsigned char *is_written;
    unsigned char bytes[];
} dense_room;

static size_t room_bytes(const dense_out *d) { return d->step * d->row_bytes + WORD_BYTES; }

static bool begin_room(void *data, void *place)
{
    dense_room *const room = place;
    room->is_written = room->bytes + room_bytes(data);
    return true;
}

/* Bit i of a byte becomes byte i. */
static uint64_t spread(uint64_t byte)
{
    const uint64_t own = (byte * UINT64_C(0x0101010101010101)) & UINT64_C(0x8040201008040201);
    return (own + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
}

/* A byte of a set cell is 1, and 1 more where it is inside. */
static void set_bytes(const dense_out *d, uint64_t word, uint64_t inside, unsigned char bytes[WORD_BYTES])
{
    if (d->has_words)
        little_put64(bytes, word);
    else
        for (unsigned i = 0; i < 64; i += 8)
            little_put64(bytes + i, spread(word >> i & 0xff) + (inside ? spread(inside >> i & 0xff) : 0));
}

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

/* In a room that is there from `from` on. Bytes beyond the end of a row are zeros, which the row after it is put over. */
static void put_row(const dense_out *d, dense_room *r, uint64_t from, uint64_t row)
{
    const uint64_t at = d->start + row * d->row_bytes, end = at + d->row_bytes;
    const uint64_t *const words = d->v->words + row * d->row_words;
    const uint64_t *const inside = d->v->inside ? d->v->inside + row * d->row_words : NULL;
    const size_t each = d->has_words ? sizeof *words : WORD_BYTES;
    uint64_t any = 0;
    for (size_t w = 0; w < d->row_words; w++)
        any |= words[w];
    for (size_t w = 0; any && w < d->row_words; w++)
        if (words[w]) {
            const uint64_t first = at + each * w;
            set_bytes(d, words[w], inside ? inside[w] : 0, r->bytes + (first - from));
            r->is_written[first / BLOCK - from / BLOCK] = true;
            r->is_written[(least(first + each, end) - 1) / BLOCK - from / BLOCK] = true;
        }
}

/* Writes what is in the room of these bytes of the file, and clears it. Returns 0, or errno. */
static int write_room(const dense_out *d, dense_room *r, uint64_t from, uint64_t to)
{
    const uint64_t first = from / BLOCK;
    const size_t blocks = (size_t)((to - 1) / BLOCK - first + 1);
    int reason = 0;
    if (to == d->start + d->rows * d->row_bytes)
        r->is_written[blocks - 1] = true; /* the length of a file is where its bytes end */
    for (size_t b = 0, end; b < blocks && !reason; b = end + 1) {
        for (end = b; end < blocks && (r->is_written[end] || !d->has_places); end++)
            r->is_written[end] = false;
        const uint64_t low = b ? (first + b) * BLOCK : from, high = end < blocks ? (first + end) * BLOCK : to;
        const size_t count = end > b ? (size_t)(high - low) : 0;
        unsigned char *const bytes = r->bytes + (low - from);
        if (count && !(d->has_places ? named_file_write_at(d->to, low, bytes, count) : fwrite(bytes, 1, count, d->to) == count))
            reason = errno ? errno : EIO;
        memset(bytes, 0, count);
    }
    return reason;
}

/* Returns 0, or an errno less than it. */
static int put_step(void *data, void *room, size_t n)
{
    const dense_out *const d = data;
    const uint64_t first = (uint64_t)n * d->step, end = least(d->rows, first + d->step);
    const uint64_t from = d->start + first * d->row_bytes;
    for (uint64_t row = first; row < end; row++)
        put_row(d, room, from, row);
    progress_tell(d->bar, (double)end / (double)d->rows);
    return -write_room(d, room, from, d->start + end * d->row_bytes);
}

static int write_ids(FILE *to, const int32_t *ids, uint64_t cells, progress *bar)
{
    int32_t chunk[1 << 12];
    for (uint64_t c = 0, count; c < cells && !ferror(to); c += count) {
        count = least(sizeof chunk / sizeof *chunk, cells - c);
        memcpy(chunk, ids + c, (size_t)count * sizeof *ids);
        little_turn(chunk, (size_t)count, sizeof *ids);
        fwrite(chunk, sizeof *ids, (size_t)count, to);
        progress_tell(bar, (double)(c + count) / (double)cells);
    }
    return ferror(to) ? errno : 0;
}

/* Returns 0, or errno. */
static int write_cells(dense_out *d, unsigned threads)
{
    const crew_work work = {.count = (size_t)((d->rows + d->step - 1) / d->step),
                            .threads = d->has_places ? threads : 1,
                            .place_bytes = sizeof(dense_room) + room_bytes(d) + room_bytes(d) / BLOCK + 2,
                            .begin = begin_room,
                            .step = put_step};
    if (d->has_places && !fflush(d->to))
        d->start = (uint64_t)ftello(d->to);
    if (ferror(d->to))
        return errno;
    const int code = crew_do(&work, d);
    if (code)
        return code == (int)MESSAGE_NO_MEMORY ? ENOMEM : -code;
    return d->has_places && fseeko(d->to, (off_t)(d->start + d->rows * d->row_bytes), SEEK_SET) ? errno : 0;
}

int dense_write(brick_out *out, progress *bar)
{
    const voxels *const v = &out->cells;
    const uint32_t *const size = v->grid.size;
    const volume_frame *const frame = out->format->writer->frame;
    dense_out d = {.to = out->to, .v = v, .has_places = out->to != stdout, .row_words = voxels_row_words(&v->grid), .bar = bar};
    d.has_words = frame->has_words && !v->inside;
    d.row_bytes = d.has_words ? sizeof(uint64_t) * d.row_words : size[0];
    d.rows = (uint64_t)size[1] * size[2];
    d.step = d.row_bytes < STEP ? STEP / d.row_bytes : 1;
    errno = 0;
    if (frame->before)
        frame->before(d.to, v);
    const int reason = v->ids ? write_ids(d.to, v->ids, d.rows * size[0], bar) : write_cells(&d, out->threads);
    if (!reason && frame->after)
        frame->after(d.to);
    if (reason)
        errno = reason;
    return reason || ferror(d.to) ? file_out_failure(out->file) : EXIT_CODE_OK;
}
