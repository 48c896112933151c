/* partition_write.c - writes tiles by threads that take a few at a time, then what the index says of them. */
#define _POSIX_C_SOURCE 200809L
#include "partition_write.h"

#include <errno.h>
#include <inttypes.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "tile_window.h"
#include "voxelize/tile_work.h"
#include "write/checksum.h"

enum { NUMBERS = 9 };

/* What the threads share. */
typedef struct writing {
    folder_out *out;
    const tile_runs *runs;
    const partition_header *header;
    partition_tile *records;
    size_t room; /* triangles that a thread has in memory */
    progress bar;
    pthread_mutex_t lock; /* of what follows */
    size_t next;          /* record */
    uint64_t done;        /* triangles */
    int reason;           /* errno of the first write that failed */
    bool lacks_memory;
    const tile_run *damaged;
} writing;

static size_t triangle_bytes(const writing *w) { return NUMBERS * w->header->position_bytes; }

static uint64_t end_of(const writing *w, size_t r) { return r < w->header->records ? w->records[r].first : w->header->places; }

static bool take(writing *w, size_t *from, size_t *to)
{
    pthread_mutex_lock(&w->lock);
    *from = *to = w->next;
    if (!w->reason && !w->lacks_memory && !w->damaged)
        while (*to < w->header->records && (*to == *from || end_of(w, *to + 1) - w->records[*from].first <= w->room))
            ++*to;
    w->next = *to;
    pthread_mutex_unlock(&w->lock);
    return *from < *to;
}

static bool write_at(FILE *file, uint64_t at, const void *bytes, size_t size)
{
    return !fseeko(file, (off_t)at, SEEK_SET) && fwrite(bytes, 1, size, file) == size;
}

/* The system takes one write to a file at a time anyway. */
static bool put(void *data, uint64_t first, size_t count, const tile_window *from)
{
    writing *const w = data;
    const size_t each = from->triangle_bytes, number = sizeof *from->numbers;
    pthread_mutex_lock(&w->lock);
    errno = 0;
    const bool is_written = !w->reason && write_at(w->out->file[1], first * each, from->bytes, count * each) &&
                            (!from->numbers || write_at(w->out->file[2], first * number, from->numbers, count * number));
    if (!is_written && !w->reason)
        w->reason = errno ? errno : EIO;
    w->done += count;
    progress_tell(&w->bar, (double)w->done / (double)w->header->places);
    pthread_mutex_unlock(&w->lock);
    return is_written;
}

static void fail(writing *w, bool lacks_memory, const tile_run *damaged, int reason)
{
    pthread_mutex_lock(&w->lock);
    w->lacks_memory |= lacks_memory;
    w->damaged = w->damaged ? w->damaged : damaged;
    w->reason = w->reason ? w->reason : reason;
    pthread_mutex_unlock(&w->lock);
}

static void work(void *data, unsigned thread)
{
    writing *const w = data;
    tile_window window = {.runs = w->runs, .records = w->records, .triangle_bytes = triangle_bytes(w), .room = w->room};
    (void)thread;
    window.bytes = malloc(w->room * window.triangle_bytes);
    window.at = malloc(w->room * sizeof *window.at);
    window.read = malloc(w->room * window.triangle_bytes);
    if (w->header->number_bytes) {
        window.numbers = malloc(w->room * sizeof *window.numbers);
        window.numbers_read = malloc(w->room * sizeof *window.numbers);
    }
    if (!window.bytes || !window.at || !window.read || (w->header->number_bytes && (!window.numbers || !window.numbers_read)))
        fail(w, true, NULL, 0);
    for (size_t from, to; take(w, &from, &to);) {
        const tile_run *damaged;
        if (!tile_window_write(&window, from, to, end_of(w, to), put, w, &damaged))
            fail(w, false, damaged, damaged ? 0 : errno ? errno : EIO);
    }
    free(window.bytes);
    free(window.at);
    free(window.read);
    free(window.numbers);
    free(window.numbers_read);
}

/* NULL where there is no memory. */
static partition_tile *make_records(const tile_runs *runs, partition_header *header)
{
    size_t filled = 0, r = 0;
    for (size_t t = 0; t < runs->tiles; t++)
        filled += runs->counts[t] != 0;
    partition_tile *const records = malloc((filled ? filled : 1) * sizeof *records);
    header->records = filled;
    header->places = 0;
    for (size_t t = 0; records && t < runs->tiles; t++)
        if (runs->counts[t]) {
            records[r++] = (partition_tile){.tile = t, .first = header->places, .work = TILE_WORK + runs->work[t]};
            header->places += runs->counts[t];
        }
    return records;
}

static int check_counts(const tile_runs *runs)
{
    for (size_t t = 0; t < runs->tiles; t++)
        if (runs->counts[t] > UINT32_MAX)
            return message_failure("a tile has %" PRIu64 " triangles, more than 4294967295; choose smaller cells", runs->counts[t]);
    return EXIT_CODE_OK;
}

static void write_index(folder_out *out, partition_header *header, const partition_tile *records)
{
    header->checksum = checksum_bytes(CHECKSUM_EMPTY, header, offsetof(partition_header, checksum));
    header->checksum = checksum_bytes(header->checksum, records, (size_t)header->records * sizeof *records);
    fwrite(header, sizeof *header, 1, out->file[0]);
    fwrite(records, sizeof *records, (size_t)header->records, out->file[0]);
}

static int write_triangles(writing *w, unsigned threads, bool is_quiet)
{
    w->bar = progress_start_of("writing", "triangles", (double)w->header->places, !is_quiet);
    pthread_mutex_init(&w->lock, NULL);
    crew_run(threads, work, w);
    pthread_mutex_destroy(&w->lock);
    progress_end(&w->bar);
    return w->damaged ? message_failure("%s: damaged: the checksum of its triangles does not match; make the partition again",
                                        w->damaged->from->path)
           : w->lacks_memory ? message_failure("out of memory to write the triangles; give less with --memory, or fewer --threads")
           : w->reason       ? folder_out_failure(w->out, w->reason)
                             : EXIT_CODE_OK;
}

int partition_write(folder_out *out, tile_runs *runs, unsigned threads, bool is_quiet, partition_header *header)
{
    enum { LEAST = 64 };
    const uint64_t each = 2 * (NUMBERS * header->position_bytes + header->number_bytes) + sizeof(uint64_t);
    const uint64_t room = runs->memory / 4 / threads / each;
    writing w = {.out = out, .runs = runs, .header = header, .room = room < LEAST ? LEAST : (size_t)room / 2 * 2};
    int code = check_counts(runs);
    if (code)
        return code;
    w.records = make_records(runs, header);
    if (!w.records)
        return message_failure("out of memory for the table of tiles");
    const uint64_t share = header->places / 4 / threads / 2 * 2; /* so that all threads have something to do */
    w.room = share < LEAST ? LEAST : share < w.room ? (size_t)share : w.room;
    setvbuf(out->file[1], NULL, _IONBF, 0);
    if (header->number_bytes)
        setvbuf(out->file[2], NULL, _IONBF, 0);
    code = write_triangles(&w, threads, is_quiet);
    if (!code)
        write_index(out, header, w.records);
    free(w.records);
    return code;
}
