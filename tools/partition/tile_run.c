/* tile_run.c - puts runs into files and reads them back. */
#define _POSIX_C_SOURCE 200809L
#include "tile_run.h"

#include <errno.h>

enum { NUMBERS = 9 };

uint64_t tile_run_count(const tile_run *run, size_t i)
{
    return (i + 1 < run->count ? run->tiles[i + 1].first : run->places) - run->tiles[i].first;
}

bool run_file_is_open(const run_file *file) { return file->numbers; }

static FILE *open_stream(const folder_out *out)
{
    FILE *const stream = folder_out_spill(out);
    if (stream)
        setvbuf(stream, NULL, _IONBF, 0);
    return stream;
}

static bool open_file(run_file *file, const folder_out *out)
{
    file->tiles = open_stream(out);
    file->triangles = file->tiles ? open_stream(out) : NULL;
    file->numbers = file->triangles ? open_stream(out) : NULL;
    if (!file->numbers)
        return false;
    pthread_mutex_init(&file->reading, NULL);
    return true;
}

bool run_file_put(run_file *file, const folder_out *out, tile_run *run)
{
    const size_t bytes = NUMBERS * run->position_bytes;
    if (!run_file_is_open(file) && !open_file(file, out))
        return false;
    run->file = file;
    run->tiles_at = file->tiles_written;
    run->triangles_at = file->triangles_written;
    run->numbers_at = file->numbers_written;
    file->tiles_written += run->count * sizeof *run->tiles;
    file->triangles_written += run->places * bytes;
    file->numbers_written += run->numbers ? run->places * sizeof *run->numbers : 0;
    return fwrite(run->tiles, sizeof *run->tiles, run->count, file->tiles) == run->count &&
           fwrite(run->triangles, bytes, (size_t)run->places, file->triangles) == run->places &&
           (!run->numbers || fwrite(run->numbers, sizeof *run->numbers, (size_t)run->places, file->numbers) == run->places);
}

bool run_file_map(run_file *file) { return file_map_of_stream(&file->map, file->tiles); }

void run_file_find(tile_run *run)
{
    run->tiles = (const void *)((const unsigned char *)run->file->map.bytes + run->tiles_at);
    run->triangles = NULL;
    run->numbers = NULL;
}

static bool read_at(FILE *stream, uint64_t at, size_t size, void *to)
{
    return !fseeko(stream, (off_t)at, SEEK_SET) && fread(to, 1, size, stream) == size;
}

bool run_file_read(const tile_run *run, uint64_t first, size_t count, void *to, uint32_t *numbers)
{
    const size_t bytes = NUMBERS * run->position_bytes;
    run_file *const file = run->file;
    pthread_mutex_lock(&file->reading);
    errno = 0;
    const bool is_read =
        read_at(file->triangles, run->triangles_at + first * bytes, count * bytes, to) &&
        (!numbers || read_at(file->numbers, run->numbers_at + first * sizeof *numbers, count * sizeof *numbers, numbers));
    const int reason = errno;
    pthread_mutex_unlock(&file->reading);
    errno = reason;
    return is_read;
}

void run_file_close(run_file *file)
{
    file_map_close(&file->map);
    if (run_file_is_open(file))
        pthread_mutex_destroy(&file->reading);
    if (file->numbers)
        fclose(file->numbers);
    if (file->triangles)
        fclose(file->triangles);
    if (file->tiles)
        fclose(file->tiles);
}
