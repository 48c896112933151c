/*
 * dense_out.c - the cells of a grid at their places in a file, with holes where none is set: spreads words to the bytes of blocks
 * that have a cell, and writes these; by threads, some layers each.
 */
#define _POSIX_C_SOURCE 200809L
#include "brick_out.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"
#include "files/files.h"
#include "read/little.h"

/*
 * A block is the least that file systems leave out. Blocks with a cell are gathered in their order and written a run at a time, as
 * long as it is: systems then take pages together, three times as fast as one by one. A room takes about what dense_put is handed,
 * so that of two threads one spreads while the other writes: systems let one thread at a time write to a file.
 */
enum { BLOCK = 1 << 12, BLOCKS = 1 << 9, ROOM = BLOCKS * BLOCK };

typedef struct dense_out {
    const file_out *file;
    const volume_frame *frame;
    const voxels *v;
    const tribox_grid *grid;
    uint32_t step;       /* layers that are put at once */
    bool has_words;      /* of the frame, and there are no labels */
    uint64_t start, end; /* of the cells in the file */
    bool has_places;     /* else it takes bytes as they come */
    progress *bar;
    pthread_mutex_t lock; /* of the file and of what follows */
    uint64_t written;     /* where what takes bytes as they come is */
    int reason;           /* of what failed first */
} dense_out;

/* Bytes that follow each other in the file. */
typedef struct run {
    uint64_t at;
    size_t count;
} run;

/* What a thread gathers bytes in. */
typedef struct dense_room {
    uint64_t from, to;         /* what is being put of the file */
    uint64_t end;              /* of the last block, whose cells come now */
    size_t filled, runs, most; /* most: bytes that there is room for */
    run run[BLOCKS];
    unsigned char bytes[];
} dense_room;

/* Where memory is short less does, and slower. */
static void *make_room(void *data)
{
    (void)data;
    dense_room *room = NULL;
    for (size_t most = ROOM; !room && most >= BLOCK; most /= 2) {
        room = malloc(sizeof *room + most);
        if (room)
            room->most = most;
    }
    return room;
}

static void fail(dense_out *d, int reason)
{
    if (!d->reason)
        d->reason = reason ? reason : EIO;
}

static void start(dense_out *d, const volume_frame *frame, const file_out *file, const voxels *v)
{
    const tribox_grid *const grid = &v->grid;
    FILE *const to = file->stream;
    const uint64_t cells = (uint64_t)grid->size[0] * grid->size[1] * grid->size[2];
    const bool has_words = frame->has_words && !voxels_have_labels(v);
    const uint64_t bytes = has_words ? 8 * (uint64_t)voxels_layer_words(grid) * grid->size[2] : cells;
    *d = (dense_out){.frame = frame, .file = file, .v = v, .grid = grid, .has_words = has_words, .has_places = to != stdout};
    pthread_mutex_init(&d->lock, NULL);
    errno = 0;
    if (frame->before)
        frame->before(to, v);
    if (d->has_places && !fflush(to))
        d->start = (uint64_t)ftello(to);
    if (ferror(to))
        fail(d, errno);
    d->written = d->start;
    d->end = d->start + bytes;
}

static bool write_zeros(FILE *to, uint64_t count)
{
    static const unsigned char zeros[BLOCK];
    for (size_t now; count; count -= now) {
        now = count < BLOCK ? (size_t)count : BLOCK;
        if (fwrite(zeros, 1, now, to) != now)
            return false;
    }
    return true;
}

/* What takes bytes as they come gets the zeros too. */
static bool write_run(dense_out *d, const run *next, const unsigned char *bytes)
{
    FILE *const to = d->file->stream;
    if (d->has_places)
        return named_file_write_at(to, next->at, bytes, next->count);
    const uint64_t before = next->at - d->written;
    d->written = next->at + next->count;
    return write_zeros(to, before) && fwrite(bytes, 1, next->count, to) == next->count;
}

/* False after a failure. */
static bool write_room(dense_out *d, dense_room *r)
{
    const unsigned char *from = r->bytes;
    pthread_mutex_lock(&d->lock);
    for (size_t i = 0; i < r->runs && !d->reason; from += r->run[i++].count)
        if (!write_run(d, &r->run[i], from))
            fail(d, errno);
    const bool is_ok = !d->reason;
    pthread_mutex_unlock(&d->lock);
    r->filled = r->runs = 0;
    return is_ok;
}

/* Room for the block of a byte, as far as it is to be put. */
static void begin_block(dense_out *d, dense_room *r, uint64_t at)
{
    const uint64_t block = at / BLOCK * BLOCK, from = block < r->from ? r->from : block;
    r->end = r->to - block < BLOCK ? r->to : block + BLOCK;
    const size_t count = (size_t)(r->end - from);
    if (r->filled + count > r->most)
        write_room(d, r);
    memset(r->bytes + r->filled, 0, count);
    r->filled += count;
    run *const last = &r->run[r->runs ? r->runs - 1 : 0];
    if (r->runs && last->at + last->count == from)
        last->count += count;
    else
        r->run[r->runs++] = (run){from, count};
}

static unsigned char *place_of(dense_room *r, uint64_t at) { return r->bytes + r->filled - (size_t)(r->end - at); }

/* Bit i of a byte becomes byte i. */
static uint64_t spread(uint64_t byte)
{
    const uint64_t own = (byte * UINT64_C(0x0101010101010101)) & UINT64_C(0x8040201008040201);
    return (own + UINT64_C(0x7f7f7f7f7f7f7f7f)) >> 7 & UINT64_C(0x0101010101010101);
}

/* A byte of a set cell is 1, and 1 more where it is inside. */
static void set_bytes(const dense_out *d, uint64_t word, uint64_t inside, unsigned char bytes[64])
{
    if (d->has_words)
        little_put64(bytes, word);
    else
        for (unsigned i = 0; i < 64; i += 8)
            little_put64(bytes + i, spread(word >> i & 0xff) + (inside ? spread(inside >> i & 0xff) : 0));
}

static void copy(dense_out *d, dense_room *r, uint64_t at, const unsigned char *bytes, size_t count)
{
    for (size_t done = 0, now; done < count; done += now) {
        if (at + done >= r->end)
            begin_block(d, r, at + done);
        now = count - done < r->end - at - done ? count - done : (size_t)(r->end - at - done);
        memcpy(place_of(r, at + done), bytes + done, now);
    }
}

/* Words come in their order: what is written beyond the last cells of a row are zeros where there are none yet. */
static void put_word(dense_out *d, dense_room *r, uint64_t at, uint64_t word, uint64_t inside, size_t count)
{
    unsigned char apart[64];
    const bool is_in = at + sizeof apart <= r->end;
    set_bytes(d, word, inside, is_in ? place_of(r, at) : apart);
    if (!is_in)
        copy(d, r, at, apart, count);
}

static bool is_empty(const uint64_t *words, size_t count)
{
    uint64_t any = 0;
    for (size_t w = 0; w < count; w++)
        any |= words[w];
    return !any;
}

static void put_row(dense_out *d, dense_room *r, uint64_t at, const uint64_t *row, const uint64_t *inside)
{
    const uint32_t cells = d->grid->size[0], each = d->has_words ? 8 : 64;
    const size_t words = voxels_row_words(d->grid), bytes = d->has_words ? 8 * words : cells;
    for (size_t w = 0; w < words; w++) {
        const size_t left = bytes - each * w;
        if (row[w])
            put_word(d, r, at + each * w, row[w], inside ? inside[w] : 0, left < each ? left : each);
    }
}

static bool put(dense_out *d, dense_room *r, uint32_t first, uint32_t layers, const uint64_t *words, const uint64_t *inside)
{
    const size_t row_words = voxels_row_words(d->grid), row_bytes = d->has_words ? 8 * row_words : d->grid->size[0];
    const uint64_t layer_bytes = (uint64_t)row_bytes * d->grid->size[1];
    r->from = r->end = d->start + first * layer_bytes;
    r->to = r->from + layers * layer_bytes;
    r->filled = r->runs = 0;
    for (uint64_t at = r->from; at < r->to; at += row_bytes, words += row_words) {
        if (!is_empty(words, row_words))
            put_row(d, r, at, words, inside);
        if (inside)
            inside += row_words;
    }
    if (r->to == d->end && r->end < r->to)
        begin_block(d, r, r->to - 1); /* the length of a file is where its bytes end */
    return write_room(d, r);
}

static int end(dense_out *d)
{
    FILE *const to = d->file->stream;
    pthread_mutex_destroy(&d->lock);
    errno = 0;
    if (!d->reason && d->has_places && fseeko(to, (off_t)d->end, SEEK_SET))
        fail(d, errno);
    if (!d->reason && d->frame->after)
        d->frame->after(to);
    if (!d->reason && ferror(to))
        fail(d, errno);
    errno = d->reason;
    return d->reason ? file_out_failure(d->file) : EXIT_CODE_OK;
}

static int put_step(void *data, void *room, size_t n)
{
    dense_out *const d = data;
    const uint32_t size = d->grid->size[2], first = (uint32_t)n * d->step, last = size - first < d->step ? size : first + d->step;
    bool is_put = true;
    for (uint32_t k = first, layers; is_put && k < last; k += layers) {
        layers = voxels_layers_from(d->v, k);
        layers = layers < last - k ? layers : last - k;
        is_put = put(d, room, k, layers, voxels_layer(d->v, k), voxels_layer_inside(d->v, k));
    }
    return is_put ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

static int tell_step(void *data, void *room, size_t n)
{
    const dense_out *const d = data;
    const uint64_t done = (uint64_t)d->step * (n + 1), size = d->grid->size[2];
    (void)room;
    progress_tell(d->bar, done < size ? (double)done / (double)size : 1);
    return EXIT_CODE_OK;
}

/* Layers of so many bytes are taken at once: fewer are not worth a thread. */
enum { STEP = 1 << 24 };

int dense_write(const volume_frame *frame, const file_out *file, const voxels *v, unsigned threads, progress *bar)
{
    dense_out d;
    const uint32_t *const size = v->grid.size;
    const uint64_t layer = (uint64_t)size[0] * size[1], step = STEP / layer;
    start(&d, frame, file, v);
    d.step = step ? (uint32_t)step : 1;
    d.bar = bar;
    const crew_work work = {.count = (size[2] + d.step - 1) / d.step,
                            .threads = d.has_places ? threads : 1,
                            .begin = make_room,
                            .end = free,
                            .step = put_step,
                            .tell = tell_step};
    if (crew_do(&work, &d) == MESSAGE_NO_MEMORY)
        fail(&d, ENOMEM);
    return end(&d);
}
