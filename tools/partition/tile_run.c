/* tile_run.c - room for runs, and files for those that memory does not hold. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdlib.h>

#include "console/message.h"
#include "console/processors.h"
#include "files/named_file.h"
#include "tile_runs.h"

enum { NUMBERS = 9 };

int tile_runs_start(tile_runs *r, const tribox_grid *grid, uint32_t tile, bool has_numbers, size_t count, uint64_t memory)
{
    const size_t tiles = tribox_tile_count(grid->size, tile);
    *r = (tile_runs){.grid = grid, .tile = tile, .tiles = tiles, .has_numbers = has_numbers, .memory = memory};
    r->runs = calloc(count ? count : 1, sizeof *r->runs);
    r->counts = calloc(r->tiles, sizeof *r->counts);
    r->work = calloc(r->tiles, sizeof *r->work);
    r->files = calloc(THREADS_MAX, sizeof *r->files);
    if (!r->runs || !r->counts || !r->work || !r->files)
        return message_failure("out of memory for the table of tiles");
    r->count = count;
    return EXIT_CODE_OK;
}

void tile_runs_free(tile_runs *r)
{
    for (size_t i = 0; i < r->count; i++)
        free(r->runs[i].room);
    for (int f = 0; r->files && f < THREADS_MAX; f++)
        run_file_close(&r->files[f]);
    free(r->files);
    free(r->runs);
    free(r->counts);
    free(r->work);
    *r = (tile_runs){.count = 0};
}

uint64_t tile_run_count(const tile_run *run, size_t i)
{
    return (i + 1 < run->count ? run->tiles[i + 1].first : run->places) - run->tiles[i].first;
}

static FILE *open_stream(const folder_out *out)
{
    FILE *const stream = folder_out_spill(out);
    if (stream)
        setvbuf(stream, NULL, _IONBF, 0);
    return stream;
}

bool run_file_put(run_file *file, const folder_out *out, tile_run *run)
{
    const size_t places = (size_t)run->places, tiles = run->count * sizeof *run->tiles;
    const size_t triangles = places * NUMBERS * run->position_bytes, numbers = run->numbers ? places * sizeof *run->numbers : 0;
    if (!file->tiles)
        file->tiles = open_stream(out);
    if (file->tiles && !file->rest)
        file->rest = open_stream(out);
    if (!file->rest)
        return false;
    run->file = file;
    run->tiles_at = file->tiles_written;
    run->triangles_at = file->rest_written;
    file->tiles_written += tiles;
    file->rest_written += triangles + numbers;
    return fwrite(run->tiles, 1, tiles, file->tiles) == tiles && fwrite(run->triangles, 1, triangles, file->rest) == triangles &&
           (!numbers || fwrite(run->numbers, 1, numbers, file->rest) == numbers);
}

bool run_file_map(run_file *file) { return !file->rest || file_map_of_stream(&file->map, file->tiles); }

void run_file_find(tile_run *run)
{
    run->tiles = (const void *)((const unsigned char *)run->file->map.bytes + run->tiles_at);
    run->triangles = NULL;
    run->numbers = NULL;
}

static bool read_at(FILE *stream, uint64_t at, size_t size, void *to)
{
    size_t got;
    errno = 0;
    return named_file_read_at(stream, at, to, size, &got) && got == size;
}

bool run_file_read(const tile_run *run, uint64_t first, size_t count, void *to, uint32_t *numbers)
{
    const size_t bytes = NUMBERS * run->position_bytes;
    const uint64_t numbers_at = run->triangles_at + run->places * bytes + first * sizeof *numbers;
    return read_at(run->file->rest, run->triangles_at + first * bytes, count * bytes, to) &&
           (!numbers || read_at(run->file->rest, numbers_at, count * sizeof *numbers, numbers));
}

void run_file_close(run_file *file)
{
    file_map_close(&file->map);
    if (file->rest)
        fclose(file->rest);
    if (file->tiles)
        fclose(file->tiles);
}
