/* tile_listing.c - threads list runs of triangles, each by tile, and put the lists together tile by tile in the order of the runs. */
#define _POSIX_C_SOURCE 200809L
#include "tile_listing.h"

#include <stdlib.h>

#include "console/crew.h"
#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"
#include "console/steps.h"

/* A run of triangles. The numbers of its list count from the first of the run. */
typedef struct run {
    size_t first, count;
    size_t *starts; /* of its list */
    size_t *places; /* by tile: where in the whole list */
    tribox_status status;
} run;

enum { RUNS_MAX = 256 };

typedef struct listing {
    const voxel_task *task;
    const tribox_tiles *tiles;
    const tribox_options *options;
    run runs[RUNS_MAX];
    size_t count, longest; /* runs, and the longest of their lists */
    steps fills;
    size_t *starts; /* of all runs together, and the list */
    uint32_t *list;
} listing;

/* As many numbers, if there is memory for them: it fails here, and not where it is first touched. */
static uint32_t *take(size_t count)
{
    return count <= memory_available() / sizeof(uint32_t) ? pages_take(count * sizeof(uint32_t)) : NULL;
}

static void drop(uint32_t *list, size_t count) { pages_free(list, count * sizeof *list); }

static tribox_status list_run(const listing *l, const run *r, uint32_t *list)
{
    return voxel_task_lists(l->task, r->first, r->count, l->tiles, l->options, r->starts, list);
}

static void count_one(void *data, size_t n)
{
    listing *const l = data;
    run *const r = &l->runs[n];
    r->starts = malloc((l->tiles->count + 1) * sizeof *r->starts);
    r->places = malloc((l->tiles->count + 1) * sizeof *r->places);
    r->status = r->starts && r->places ? list_run(l, r, NULL) : MESSAGE_NO_MEMORY;
}

static tribox_status first_failure(const listing *l)
{
    tribox_status status = TRIBOX_OK;
    for (size_t n = 0; n < l->count && !status; n++)
        status = l->runs[n].status;
    return status;
}

/* In each tile the runs follow each other. */
static void find_places(listing *l)
{
    size_t place = 0;
    for (size_t t = 0; t < l->tiles->count; t++) {
        l->starts[t] = place;
        for (size_t n = 0; n < l->count; n++) {
            l->runs[n].places[t] = place;
            place += l->runs[n].starts[t + 1] - l->runs[n].starts[t];
        }
    }
    l->starts[l->tiles->count] = place;
    for (size_t n = 0; n < l->count; n++)
        if (l->runs[n].starts[l->tiles->count] > l->longest)
            l->longest = l->runs[n].starts[l->tiles->count];
}

static void put_run(const listing *l, const run *r, const uint32_t *list)
{
    const uint32_t first = (uint32_t)r->first;
    for (size_t t = 0; t < l->tiles->count; t++) {
        const uint32_t *const from = list + r->starts[t];
        uint32_t *const to = l->list + r->places[t];
        const size_t count = r->starts[t + 1] - r->starts[t];
        for (size_t i = 0; i < count; i++)
            to[i] = from[i] + first;
    }
}

/* A thread more without memory fills none. */
static void fill_some(void *data, unsigned thread)
{
    listing *const l = data;
    uint32_t *const list = take(l->longest);
    for (size_t n; (list || !thread) && steps_take(&l->fills, &n);) {
        run *const r = &l->runs[n];
        r->status = list ? list_run(l, r, list) : MESSAGE_NO_MEMORY;
        if (!r->status)
            put_run(l, r, list);
    }
    drop(list, l->longest);
}

static tribox_status fill_list(listing *l, unsigned threads)
{
    find_places(l);
    l->list = take(l->starts[l->tiles->count]);
    if (!l->list)
        return MESSAGE_NO_MEMORY;
    steps_start(&l->fills, l->count);
    crew_run(threads, fill_some, l);
    steps_free(&l->fills);
    return first_failure(l);
}

/* Several for each thread, as some take longer, of so many triangles that the starts of all are little beside them. */
static size_t runs_for(const voxel_task *task, const tribox_tiles *tiles, unsigned threads)
{
    enum { EACH = 4, LEAST = 1 << 13 };
    const size_t least = tiles->count > LEAST ? tiles->count : LEAST, most = task->count / least;
    const size_t wanted = threads < RUNS_MAX / EACH ? EACH * (size_t)threads : RUNS_MAX;
    if (threads < 2 || most < 2 || task->count > UINT32_MAX) /* the library refuses so many */
        return 1;
    return wanted < most ? wanted : most;
}

static tribox_status list_in_runs(listing *l, unsigned threads)
{
    const size_t all = l->task->count;
    for (size_t n = 0; n < l->count; n++) {
        const size_t first = all / l->count * n, end = n + 1 < l->count ? all / l->count * (n + 1) : all;
        l->runs[n] = (run){.first = first, .count = end - first};
    }
    crew_each(threads, l->count, count_one, l);
    const tribox_status status = first_failure(l) ? first_failure(l) : fill_list(l, threads);
    for (size_t n = 0; n < l->count; n++) {
        free(l->runs[n].starts);
        free(l->runs[n].places);
    }
    return status;
}

static tribox_status list_whole(listing *l)
{
    const run whole = {.count = l->task->count, .starts = l->starts};
    const tribox_status status = list_run(l, &whole, NULL);
    if (status)
        return status;
    l->list = take(l->starts[l->tiles->count]);
    return l->list ? list_run(l, &whole, l->list) : MESSAGE_NO_MEMORY;
}

tribox_status tile_listing_make(const voxel_task *task, const tribox_tiles *tiles, const tribox_options *options, unsigned threads,
                                size_t *starts, uint32_t **list)
{
    listing l = {.task = task, .tiles = tiles, .options = options, .count = runs_for(task, tiles, threads), .starts = starts};
    const tribox_status status = l.count > 1 ? list_in_runs(&l, threads) : list_whole(&l);
    if (status && l.list)
        drop(l.list, starts[tiles->count]);
    else
        *list = l.list;
    return status;
}

void tile_listing_free(uint32_t *list, size_t count) { drop(list, count); }
