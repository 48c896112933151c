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

/* Triangles of a run, read if they are in a file. NULL with errno. */
static const unsigned char *bring(const tile_window *w, const tile_run *run, uint64_t first, size_t count)
{
    if (run->triangles)
        return run->triangles + first * NUMBERS * run->position_bytes;
    return run_file_read(run, first, count, w->read) ? w->read : NULL;
}

/* What a partition wrote is looked at before it is copied. */
static bool is_sound(const tile_run *run, size_t i) { return !run->from || partition_is_sound(run->from, i); }

/* Triangles of a run as wide as they are to be. */
static void copy(const tile_window *w, const tile_run *run, const unsigned char *from, size_t count, unsigned char *to)
{
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
    const unsigned char *const triangles = bring(w, run, start, (size_t)(after - start));
    size_t r = from;
    for (size_t i = first; triangles && i < end; i++) {
        const size_t count = (size_t)tile_run_count(run, i);
        while (w->records[r].tile < run->tiles[i].tile)
            r++;
        copy(w, run, triangles + (run->tiles[i].first - start) * NUMBERS * run->position_bytes, count,
             w->bytes + (w->at[r - from] - w->records[from].first) * w->triangle_bytes);
        w->at[r - from] += count;
    }
    return triangles;
}

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
        w->records[r].checksum = checksum_bytes(CHECKSUM_EMPTY, w->bytes + (first - start) * w->triangle_bytes,
                                                (size_t)(after - first) * w->triangle_bytes);
    }
    return sink(data, start * w->triangle_bytes, w->bytes, (size_t)(end - start) * w->triangle_bytes);
}

/* Writes what has gathered of a large tile: but for its end an even number of triangles, so whole words for the checksum. */
static bool flush(const tile_window *w, partition_tile *record, size_t count, uint64_t *at, tile_window_sink *sink, void *data)
{
    const size_t size = count * w->triangle_bytes;
    const uint64_t to = *at;
    record->checksum = checksum_bytes(record->checksum, w->bytes, size);
    *at += size;
    return sink(data, to, w->bytes, size);
}

/* A tile that does not fit into the room, piece by piece. */
static bool write_large(tile_window *w, size_t r, tile_window_sink *sink, void *data, const tile_run **damaged)
{
    partition_tile *const record = &w->records[r];
    uint64_t at = record->first * w->triangle_bytes;
    size_t held = 0;
    record->checksum = CHECKSUM_EMPTY;
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
            const unsigned char *const triangles = bring(w, run, run->tiles[i].first + done, some);
            if (!triangles)
                return false;
            copy(w, run, triangles, some, w->bytes + held * w->triangle_bytes);
            held += some;
            if (held == w->room && !flush(w, record, held, &at, sink, data))
                return false;
            held %= w->room;
        }
    }
    return !held || flush(w, record, held, &at, sink, data);
}

bool tile_window_write(tile_window *w, size_t from, size_t to, uint64_t end, tile_window_sink *sink, void *data,
                       const tile_run **damaged)
{
    *damaged = NULL;
    return end - w->records[from].first > w->room ? write_large(w, from, sink, data, damaged)
                                                  : write_window(w, from, to, end, sink, data, damaged);
}
