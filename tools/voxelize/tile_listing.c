/* tile_listing.c - threads count runs of triangles by tile, and then write them to their places in one list. */
#define _POSIX_C_SOURCE 200809L
#include "tile_listing.h"

#include <stdlib.h>

#include "console/crew.h"
#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"

enum { RUNS_MAX = 256 };

typedef struct listing {
    const voxel_task *task;
    const tribox_tiles *tiles;
    const tribox_options *options;
    size_t runs;
    size_t *places; /* of each run: by tile, how many, and then where */
    tribox_status status[RUNS_MAX];
    uint32_t *list; /* NULL to count */
} listing;

/* As many numbers, if there is memory for them: it fails here, and not where it is first touched. */
static uint32_t *take(size_t count)
{
    return count <= memory_available() / sizeof(uint32_t) ? pages_take(count * sizeof(uint32_t)) : NULL;
}

static size_t *places_of(const listing *l, size_t run) { return l->places + run * l->tiles->count; }

static void list_run(void *data, size_t run)
{
    listing *const l = data;
    const size_t each = l->task->count / l->runs, first = each * run, count = run + 1 < l->runs ? each : l->task->count - first;
    l->status[run] = voxel_task_lists(l->task, first, count, l->tiles, l->options, places_of(l, run), l->list);
}

static tribox_status list_runs(listing *l, unsigned threads)
{
    tribox_status status = TRIBOX_OK;
    crew_each(threads, l->runs, list_run, l);
    for (size_t n = 0; n < l->runs && !status; n++)
        status = l->status[n];
    return status;
}

/* In each tile the runs follow each other. */
static void find_places(const listing *l, size_t *starts)
{
    size_t place = 0;
    for (size_t t = 0; t < l->tiles->count; t++) {
        starts[t] = place;
        for (size_t n = 0; n < l->runs; n++) {
            size_t *const of_run = places_of(l, n) + t;
            const size_t count = *of_run;
            *of_run = place;
            place += count;
        }
    }
    starts[l->tiles->count] = place;
}

/* Many for each thread, as some take longer, but so few that the places of all are little beside their triangles. */
static size_t runs_for(const voxel_task *task, const tribox_tiles *tiles, unsigned threads)
{
    enum { EACH = 32, LEAST = 1 << 11 };
    const size_t least = tiles->count > LEAST ? tiles->count : LEAST, most = task->count / least;
    const size_t wanted = threads < RUNS_MAX / EACH ? EACH * (size_t)threads : RUNS_MAX;
    return threads < 2 || !most ? 1 : wanted < most ? wanted : most;
}

static tribox_status list_all(listing *l, unsigned threads, size_t *starts)
{
    const tribox_status status = list_runs(l, threads);
    if (status)
        return status;
    find_places(l, starts);
    l->list = take(starts[l->tiles->count]);
    return l->list ? list_runs(l, threads) : MESSAGE_NO_MEMORY;
}

tribox_status tile_listing_make(const voxel_task *task, const tribox_tiles *tiles, const tribox_options *options, unsigned threads,
                                size_t *starts, uint32_t **list)
{
    listing l = {.task = task, .tiles = tiles, .options = options, .runs = runs_for(task, tiles, threads)};
    l.places = malloc(l.runs * tiles->count * sizeof *l.places);
    const tribox_status status = l.places ? list_all(&l, threads, starts) : MESSAGE_NO_MEMORY;
    free(l.places);
    if (status && l.list)
        tile_listing_free(l.list, starts[tiles->count]);
    else
        *list = l.list;
    return status;
}

void tile_listing_free(uint32_t *list, size_t count) { pages_free(list, count * sizeof *list); }
