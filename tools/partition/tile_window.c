/* tile_window.c - copies what each run has of some tiles to its place: runs come in the order of the mesh. */
#include "tile_window.h"

#include <string.h>

#include "write/checksum.h"

enum { NUMBERS = 9 };

/* The first tile of a run that is not before this one. */
static size_t find_tile(const tile_run *run, uint64_t tile)
{
    size_t lo = 0, hi = run->count;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (run->tiles[middle].tile < tile)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

/* Some triangles of a run and, where they have some, their numbers. */
typedef struct brought {
    const unsigned char *triangles;
    const uint32_t *numbers;
} brought;

/* They are read if they are in a file. No triangles with errno. */
static brought bring(const tile_window *w, const tile_run *run, uint64_t first, size_t count)
{
    if (run->triangles)
        return (brought){run->triangles + first * NUMBERS * run->position_bytes, w->numbers ? run->numbers + first : NULL};
    return (brought){run_file_read(run, first, count, w->read, w->numbers_read) ? w->read : NULL, w->numbers_read};
}

/* What a partition wrote is looked at before it is copied. */
static bool is_sound(const tile_run *run, size_t i) { return !run->from || partition_is_sound(run->from, i); }

/* Triangles of a run, after those that were brought `first`, to place `to`: as wide, and counted, as they are to be. */
static void copy(const tile_window *w, const tile_run *run, const brought *b, size_t first, size_t count, size_t place)
{
    const unsigned char *const from = b->triangles + first * NUMBERS * run->position_bytes;
    unsigned char *const to = w->bytes + place * w->triangle_bytes;
    for (size_t t = 0; b->numbers && t < count; t++)
        w->numbers[place + t] = (uint32_t)(run->before + b->numbers[first + t]);
    if (w->triangle_bytes == NUMBERS * run->position_bytes) {
        memcpy(to, from, count * w->triangle_bytes);
        return;
    }
    for (size_t k = 0; k < NUMBERS * count; k++) {
        float narrow;
        memcpy(&narrow, from + k * sizeof narrow, sizeof narrow);
        const double wide = (double)narrow;
        memcpy(to + k * sizeof wide, &wide, sizeof wide);
    }
}

static bool are_sound(const tile_run *run, size_t from, size_t to)
{
    while (from < to && is_sound(run, from))
        from++;
    return from == to;
}

/* False where they are damaged, or with errno cannot be read. */
static bool copy_run(const tile_window *w, const tile_run *run, size_t from, size_t to, const tile_run **damaged)
{
    const size_t first = find_tile(run, w->records[from].tile), end = find_tile(run, w->records[to - 1].tile + 1);
    const uint64_t start = first < end ? run->tiles[first].first : 0;
    if (first == end)
        return true;
    if (!are_sound(run, first, end)) {
        *damaged = run;
        return false;
    }
    const uint64_t after = end < run->count ? run->tiles[end].first : run->places;
    const brought b = bring(w, run, start, (size_t)(after - start));
    size_t r = from;
    for (size_t i = first; b.triangles && i < end; i++) {
        const size_t count = (size_t)tile_run_count(run, i);
        while (w->records[r].tile < run->tiles[i].tile)
            r++;
        copy(w, run, &b, (size_t)(run->tiles[i].first - start), count, (size_t)(w->at[r - from] - w->records[from].first));
        w->at[r - from] += count;
    }
    return b.triangles;
}

/* Checksums of triangles in the room, and of their numbers, each going on from one before. */
typedef struct sums {
    uint64_t triangles, numbers;
} sums;

static void add_to_sums(sums *s, const tile_window *w, size_t from, size_t count)
{
    s->triangles = checksum_bytes(s->triangles, w->bytes + from * w->triangle_bytes, count * w->triangle_bytes);
    if (w->numbers)
        s->numbers = checksum_bytes(s->numbers, w->numbers + from, count * sizeof *w->numbers);
}

static sums start_sums(const tile_window *w) { return (sums){CHECKSUM_EMPTY, w->numbers ? CHECKSUM_EMPTY : 0}; }

static uint64_t checksum_of(const sums *s) { return s->triangles + s->numbers; }

static bool write_window(tile_window *w, size_t from, size_t to, uint64_t end, tile_window_sink *sink, void *data,
                         const tile_run **damaged)
{
    const uint64_t start = w->records[from].first;
    for (size_t r = from; r < to; r++)
        w->at[r - from] = w->records[r].first;
    for (size_t i = 0; i < w->runs->count; i++)
        if (!copy_run(w, &w->runs->runs[i], from, to, damaged))
            return false;
    for (size_t r = from; r < to; r++) {
        const uint64_t first = w->records[r].first, after = r + 1 < to ? w->records[r + 1].first : end;
        sums s = start_sums(w);
        add_to_sums(&s, w, (size_t)(first - start), (size_t)(after - first));
        w->records[r].checksum = checksum_of(&s);
    }
    return sink(data, start, (size_t)(end - start), w);
}

/* Writes what has gathered of a large tile: but for its end an even number of triangles, so whole words for the checksum. */
static bool flush(const tile_window *w, sums *s, size_t count, uint64_t *at, tile_window_sink *sink, void *data)
{
    const uint64_t first = *at;
    add_to_sums(s, w, 0, count);
    *at += count;
    return sink(data, first, count, w);
}

/* A tile that does not fit into the room, piece by piece. */
static bool write_large(tile_window *w, size_t r, tile_window_sink *sink, void *data, const tile_run **damaged)
{
    partition_tile *const record = &w->records[r];
    uint64_t at = record->first;
    size_t held = 0;
    sums s = start_sums(w);
    for (size_t k = 0; k < w->runs->count; k++) {
        const tile_run *const run = &w->runs->runs[k];
        const size_t i = find_tile(run, record->tile);
        if (i == run->count || run->tiles[i].tile != record->tile)
            continue;
        if (!is_sound(run, i)) {
            *damaged = run;
            return false;
        }
        const size_t all = (size_t)tile_run_count(run, i);
        for (size_t done = 0, some; done < all; done += some) {
            some = all - done < w->room - held ? all - done : w->room - held;
            const brought b = bring(w, run, run->tiles[i].first + done, some);
            if (!b.triangles)
                return false;
            copy(w, run, &b, 0, some, held);
            held += some;
            if (held == w->room && !flush(w, &s, held, &at, sink, data))
                return false;
            held %= w->room;
        }
    }
    const bool is_written = !held || flush(w, &s, held, &at, sink, data);
    record->checksum = checksum_of(&s);
    return is_written;
}

bool tile_window_write(tile_window *w, size_t from, size_t to, uint64_t end, tile_window_sink *sink, void *data,
                       const tile_run **damaged)
{
    *damaged = NULL;
    return end - w->records[from].first > w->room ? write_large(w, from, sink, data, damaged)
                                                  : write_window(w, from, to, end, sink, data, damaged);
}
