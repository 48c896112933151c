/* tile_write.c - threads take a few tiles at a time, copy what each run has of them to its place in a file; then the index. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <inttypes.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "files/named_file.h"
#include "tile_runs.h"
#include "voxelize/tile_work.h"

enum { NUMBERS = 9 };

/* What the threads share. */
typedef struct writing {
    folder_out *out;
    const tile_runs *runs;
    const partition_header *header;
    partition_tile *records; /* of the partition that comes to be: their checksums are set */
    size_t triangle_bytes;   /* there */
    size_t room;             /* triangles that a thread has in memory, an even number */
    progress bar;
    pthread_mutex_t lock; /* of what follows */
    size_t next;          /* record */
    uint64_t done;        /* triangles */
    int code;             /* of the first failure, which ends the work */
} writing;

/* What a thread has of some tiles, one after the other. */
typedef struct window {
    writing *w;
    unsigned char *bytes, *read;      /* read: for those of a run in a file */
    uint32_t *numbers, *numbers_read; /* the same of numbers; NULL without */
    uint64_t *at;                     /* where the next triangle of each record goes */
} window;

/* Says it where it is the first. Without memory, or else what is damaged, a write or a read failed, for this reason. */
static bool fail(writing *w, bool lacks_memory, const tile_run *damaged, int reason)
{
    pthread_mutex_lock(&w->lock);
    if (!w->code) {
        progress_end(&w->bar);
        w->code = lacks_memory
                      ? message_failure("out of memory to write the triangles; give less with --memory, or fewer --threads")
                  : damaged ? partition_refuse_triangles(damaged->from)
                            : folder_out_failure(w->out, reason);
    }
    pthread_mutex_unlock(&w->lock);
    return false;
}

static uint64_t end_of(const writing *w, size_t r) { return r < w->header->records ? w->records[r].first : w->header->places; }

static bool take(writing *w, size_t *from, size_t *to)
{
    pthread_mutex_lock(&w->lock);
    *from = *to = w->next;
    while (!w->code && *to < w->header->records && (*to == *from || end_of(w, *to + 1) - w->records[*from].first <= w->room))
        ++*to;
    w->next = *to;
    pthread_mutex_unlock(&w->lock);
    return *from < *to;
}

/* Triangles to their place, that of triangle `first`. The system takes one write to a file at a time anyway. */
static bool put(const window *v, uint64_t first, size_t count)
{
    writing *const w = v->w;
    const size_t each = w->triangle_bytes, number = sizeof *v->numbers;
    errno = 0;
    if (!named_file_write_at(w->out->file[1], first * each, v->bytes, count * each) ||
        (v->numbers && !named_file_write_at(w->out->file[2], first * number, v->numbers, count * number)))
        return fail(w, false, NULL, errno);
    pthread_mutex_lock(&w->lock);
    w->done += count;
    if (!w->code)
        progress_tell(&w->bar, (double)w->done / (double)w->header->places);
    pthread_mutex_unlock(&w->lock);
    return true;
}

/* Some triangles of a run and, where they have some, their numbers. */
typedef struct brought {
    const unsigned char *triangles;
    const uint32_t *numbers;
} brought;

/* They are read if they are in a file. */
static bool bring(const window *v, const tile_run *run, uint64_t first, size_t count, brought *b)
{
    *b = (brought){v->read, v->numbers_read};
    if (run->triangles)
        *b = (brought){run->triangles + first * NUMBERS * run->position_bytes, v->numbers ? run->numbers + first : NULL};
    else if (!run_file_read(run, first, count, v->read, v->numbers_read))
        return fail(v->w, false, NULL, errno);
    return true;
}

/* Those after the `first` that were brought, to place `place`: as wide, and counted, as they are to be. */
static void copy(const window *v, const tile_run *run, const brought *b, size_t first, size_t count, size_t place)
{
    partition_copy(v->bytes + place * v->w->triangle_bytes, v->w->header->position_bytes,
                   b->triangles + first * NUMBERS * run->position_bytes, run->position_bytes, count);
    for (size_t t = 0; b->numbers && t < count; t++)
        v->numbers[place + t] = (uint32_t)(run->before + b->numbers[first + t]);
}

/* What a partition wrote is looked at before it is copied. */
static bool check(const window *v, const tile_run *run, size_t i)
{
    return !run->from || partition_is_sound(run->from, i) || fail(v->w, false, run, 0);
}

/* Checksums of triangles and of their numbers, each going on from one before. */
typedef struct sums {
    uint64_t triangles, numbers;
} sums;

static sums start_sums(const window *v) { return (sums){CHECKSUM_EMPTY, v->numbers ? CHECKSUM_EMPTY : 0}; }

static void add_to_sums(sums *s, const window *v, size_t from, size_t count)
{
    s->triangles = checksum_bytes(s->triangles, v->bytes + from * v->w->triangle_bytes, count * v->w->triangle_bytes);
    if (v->numbers)
        s->numbers = checksum_bytes(s->numbers, v->numbers + from, count * sizeof *v->numbers);
}

/* What a run has of some tiles lies there, and is brought, at once. */
static bool copy_run(const window *v, const tile_run *run, size_t from, size_t to)
{
    brought b;
    const partition_tile *const records = v->w->records;
    const size_t begin = partition_find(run->tiles, run->count, records[from].tile);
    const size_t end = partition_find(run->tiles, run->count, records[to - 1].tile + 1);
    const uint64_t start = begin < run->count ? run->tiles[begin].first : run->places;
    const uint64_t after = end < run->count ? run->tiles[end].first : run->places;
    for (size_t i = begin; i < end; i++)
        if (!check(v, run, i))
            return false;
    if (begin < end && !bring(v, run, start, (size_t)(after - start), &b))
        return false;
    size_t r = from;
    for (size_t i = begin; i < end; i++) {
        const size_t count = (size_t)tile_run_count(run, i);
        while (records[r].tile < run->tiles[i].tile)
            r++;
        copy(v, run, &b, (size_t)(run->tiles[i].first - start), count, (size_t)(v->at[r - from] - records[from].first));
        v->at[r - from] += count;
    }
    return true;
}

/* Tiles from .. to - 1, which end at place `end` of the file and fit into the room. */
static bool write_small(const window *v, size_t from, size_t to, uint64_t end)
{
    writing *const w = v->w;
    const uint64_t start = w->records[from].first;
    for (size_t r = from; r < to; r++)
        v->at[r - from] = w->records[r].first;
    for (size_t i = 0; i < w->runs->count; i++)
        if (!copy_run(v, &w->runs->runs[i], from, to))
            return false;
    for (size_t r = from; r < to; r++) {
        const uint64_t first = w->records[r].first, after = r + 1 < to ? w->records[r + 1].first : end;
        sums s = start_sums(v);
        add_to_sums(&s, v, (size_t)(first - start), (size_t)(after - first));
        w->records[r].checksum = s.triangles + s.numbers;
    }
    return put(v, start, (size_t)(end - start));
}

/* Writes what has gathered of a large tile: but for its end an even number of triangles, so whole words for the checksum. */
static bool flush(const window *v, sums *s, size_t count, uint64_t *at)
{
    const uint64_t first = *at;
    add_to_sums(s, v, 0, count);
    *at += count;
    return put(v, first, count);
}

/* A tile that does not fit into the room, piece by piece. */
static bool write_large(const window *v, size_t r)
{
    const writing *const w = v->w;
    partition_tile *const record = &w->records[r];
    uint64_t at = record->first;
    size_t held = 0;
    sums s = start_sums(v);
    for (size_t k = 0; k < w->runs->count; k++) {
        const tile_run *const run = &w->runs->runs[k];
        const size_t i = partition_find(run->tiles, run->count, record->tile);
        if (i == run->count || run->tiles[i].tile != record->tile)
            continue;
        if (!check(v, run, i))
            return false;
        const size_t all = (size_t)tile_run_count(run, i);
        for (size_t done = 0, some; done < all; done += some) {
            some = all - done < w->room - held ? all - done : w->room - held;
            brought b;
            if (!bring(v, run, run->tiles[i].first + done, some, &b))
                return false;
            copy(v, run, &b, 0, some, held);
            held += some;
            if (held == w->room && !flush(v, &s, held, &at))
                return false;
            held %= w->room;
        }
    }
    const bool is_written = !held || flush(v, &s, held, &at);
    record->checksum = s.triangles + s.numbers;
    return is_written;
}

static void work(void *data, unsigned thread)
{
    writing *const w = data;
    const bool has_numbers = w->header->number_bytes;
    window v = {.w = w, .bytes = malloc(w->room * w->triangle_bytes), .read = malloc(w->room * w->triangle_bytes)};
    (void)thread;
    v.at = malloc(w->room * sizeof *v.at);
    v.numbers = has_numbers ? malloc(w->room * sizeof *v.numbers) : NULL;
    v.numbers_read = has_numbers ? malloc(w->room * sizeof *v.numbers) : NULL;
    if (!v.bytes || !v.read || !v.at || (has_numbers && (!v.numbers || !v.numbers_read)))
        fail(w, true, NULL, 0);
    for (size_t from, to; take(w, &from, &to);)
        if (end_of(w, to) - w->records[from].first > w->room)
            write_large(&v, from);
        else
            write_small(&v, from, to, end_of(w, to));
    free(v.bytes);
    free(v.read);
    free(v.at);
    free(v.numbers);
    free(v.numbers_read);
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

int tile_write(folder_out *out, const tile_runs *runs, unsigned threads, bool is_quiet, partition_header *header)
{
    enum { LEAST = 64 };
    const uint64_t each = 2 * (NUMBERS * header->position_bytes + header->number_bytes) + sizeof(uint64_t);
    const uint64_t most = runs->memory / 4 / threads / each / 2 * 2;
    writing w = {.out = out, .runs = runs, .header = header, .triangle_bytes = NUMBERS * header->position_bytes};
    const int code = check_counts(runs);
    if (code)
        return code;
    w.records = make_records(runs, header);
    if (!w.records)
        return message_failure("out of memory for the table of tiles");
    const uint64_t share = header->places / 4 / threads / 2 * 2, room = share < most ? share : most; /* all have something to do */
    w.room = room < LEAST ? LEAST : (size_t)room;
    w.bar = progress_start_of("writing", "triangles", (double)header->places, !is_quiet);
    pthread_mutex_init(&w.lock, NULL);
    crew_run(threads, work, &w);
    pthread_mutex_destroy(&w.lock);
    progress_end(&w.bar);
    if (!w.code)
        write_index(out, header, w.records);
    free(w.records);
    return w.code;
}
