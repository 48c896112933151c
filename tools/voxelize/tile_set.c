/* tile_set.c - sorts triangles into tiles, and cuts tiles into shards. */
#define _POSIX_C_SOURCE 200809L
#include "tile_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"

/* ------------------------------------------------------------------------------------------------------------ what a tile costs */

/* By itself, by the rows that triangles cross, and by their reach. Nanoseconds, roughly: only their ratios matter. */
static const double row_cost = 10, reach_cost = 23;

static double least(double a, double b) { return a < b ? a : b; }
static double most_of(double a, double b) { return a > b ? a : b; }

/* Of a vertex and the two that lie so far from it. */
static double reach(double a, double b) { return most_of(most_of(a, b), 0) - least(least(a, b), 0); }

uint64_t tile_work_of(const tribox_grid *grid, uint32_t side, const double u[9], uint32_t tiles)
{
    const double most = 3 * row_cost * side * side;
    double e[3], f[3]; /* two edges, in cells */
    for (int a = 0; a < 3; a++) {
        e[a] = (u[3 + a] - u[a]) / grid->cell[a];
        f[a] = (u[6 + a] - u[a]) / grid->cell[a];
    }
    /* Seen along x: how many rows it crosses. */
    const double area = 0.5 * fabs(e[1] * f[2] - f[1] * e[2]);
    const double work = row_cost * area + reach_cost * (reach(e[0], f[0]) + reach(e[1], f[1]) + reach(e[2], f[2]));
    const double share = ceil(work / tiles);
    return share < most ? (uint64_t)share : isfinite(share) ? (uint64_t)most : 0;
}

/* Replaces how many tiles a triangle is in by its work in each. */
static void share_work(const tile_set *set, uint32_t *share)
{
    for (size_t t = 0; t < set->task.count; t++)
        if (share[t]) {
            double u[3][3], by_vertex[9];
            voxel_task_triangle(&set->task, t, u);
            for (int k = 0; k < 9; k++)
                by_vertex[k] = u[k % 3][k / 3];
            share[t] = (uint32_t)tile_work_of(&set->task.grid, set->tile, by_vertex, share[t]);
        }
}

/* False where there is no memory. */
static bool estimate_work(const tile_set *set, partition_tile *records)
{
    uint32_t *const share = calloc(set->task.count, sizeof *share);
    if (!share)
        return false;
    for (uint64_t p = 0; p < set->places; p++)
        share[set->list[p]]++;
    share_work(set, share);
    for (size_t r = 0; r < set->count; r++) {
        const size_t triangles = tile_set_triangles(set, r);
        const uint32_t *const list = set->list + records[r].first;
        records[r].work = TILE_WORK;
        for (size_t i = 0; i < triangles; i++)
            records[r].work += share[list[i]];
    }
    free(share);
    return true;
}

/* ------------------------------------------------------------------------------------------------------------------------ lists */

enum { RUNS_MAX = 256 };

typedef struct listing {
    const voxel_task *task;
    const tribox_tiles *tiles;
    const tribox_options *options;
    size_t runs;
    size_t *places; /* of each run: by tile, how many, and then where */
    uint32_t *list; /* NULL to count */
} listing;

/* As many numbers, if there is memory for them: it fails here, and not where it is first touched. */
static uint32_t *take_numbers(size_t count)
{
    return count <= memory_available() / sizeof(uint32_t) ? pages_take(count * sizeof(uint32_t)) : NULL;
}

static size_t *places_of(const listing *l, size_t run) { return l->places + run * l->tiles->count; }

static int list_run(void *data, void *place, size_t run)
{
    const listing *const l = data;
    (void)place;
    const size_t each = l->task->count / l->runs, first = each * run, count = run + 1 < l->runs ? each : l->task->count - first;
    return (int)voxel_task_lists(l->task, first, count, l->tiles, l->options, places_of(l, run), l->list);
}

static tribox_status list_runs(listing *l, unsigned threads)
{
    return (tribox_status)crew_do(&(crew_work){.threads = threads, .count = l->runs, .step = list_run}, l);
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
    l->list = take_numbers(starts[l->tiles->count]);
    return l->list ? list_runs(l, threads) : MESSAGE_NO_MEMORY;
}

/* Fails as tribox_tile_lists, or with MESSAGE_NO_MEMORY. */
static tribox_status make_lists(tile_set *set, unsigned threads)
{
    const tribox_tiles all = {set->tile, 0, set->tiles};
    listing l = {.task = &set->task, .tiles = &all, .options = &set->listing, .runs = runs_for(&set->task, &all, threads)};
    l.places = pages_take(l.runs * all.count * sizeof *l.places);
    const tribox_status status = l.places ? list_all(&l, threads, set->starts) : MESSAGE_NO_MEMORY;
    pages_free(l.places, l.runs * all.count * sizeof *l.places);
    set->list = l.list;
    set->places = l.list ? set->starts[set->tiles] : 0;
    return status;
}

uint32_t tile_set_side(const uint32_t size[3], bool has_ids)
{
    enum { SIDE = 128, SIDE_IDS = 64, SIDE_MOST = 1024 };
    static const size_t tiles_most = (size_t)1 << 24;
    uint32_t side = has_ids ? SIDE_IDS : SIDE;
    while (side <= SIDE_MOST && tribox_tile_count(size, side) > tiles_most)
        side *= 2;
    if (side <= SIDE_MOST)
        return side;
    message_failure("a grid of %u x %u x %u cells is too large even for tiles; choose fewer cells", size[0], size[1], size[2]);
    return 0;
}

/* Memory for `count` things of `size` bytes, if so much is available. NULL after a line. */
static void *take(size_t count, size_t size, const char *what)
{
    char needed[16], there[16];
    const uint64_t available = memory_available();
    if (count > available / size) {
        message_failure("the %s takes %s of memory and %s are available", what, memory_text((uint64_t)count * size, needed),
                        memory_text(available, there));
        return NULL;
    }
    void *const memory = malloc(count ? count * size : 1);
    if (!memory)
        message_failure("out of memory for the %s", what);
    return memory;
}

static int list_triangles(tile_set *set, unsigned threads)
{
    set->starts = take(set->tiles + 1, sizeof *set->starts, "table of tiles");
    if (!set->starts)
        return EXIT_CODE_FAILURE;
    const tribox_status status = make_lists(set, threads);
    return status == MESSAGE_NO_MEMORY ? message_failure("out of memory for the list of triangles by tile")
                                       : message_status(status);
}

static int make_records(tile_set *set, bool has_work)
{
    size_t filled = 0;
    for (size_t t = 0; t < set->tiles; t++)
        filled += set->starts[t] < set->starts[t + 1];
    set->own_records = take(filled, sizeof *set->own_records, "table of tiles");
    if (!set->own_records)
        return EXIT_CODE_FAILURE;
    for (size_t t = 0; t < set->tiles; t++)
        if (set->starts[t] < set->starts[t + 1])
            set->own_records[set->count++] = (partition_tile){.tile = t, .first = set->starts[t]};
    set->records = set->own_records;
    return !has_work || estimate_work(set, set->own_records) ? EXIT_CODE_OK : message_failure("out of memory for the shards");
}

int tile_set_of_task(const voxel_task *task, bool has_work, unsigned threads, tile_set *set)
{
    *set = (tile_set){.task = *task, .tile = tile_set_side(task->grid.size, task->has_ids), .listing = *task->options};
    /* Shards are the same on every processor, and in sum the whole: only exact cells are not decided by which tiles are asked. */
    const bool is_exact = has_work || task->options->accuracy != TRIBOX_EXACT;
    set->listing.accuracy = is_exact ? TRIBOX_EXACT : TRIBOX_CONSERVATIVE;
    if (!set->tile)
        return EXIT_CODE_FAILURE;
    set->tiles = tribox_tile_count(task->grid.size, set->tile);
    int code = list_triangles(set, threads);
    if (!code)
        code = make_records(set, has_work);
    if (code)
        tile_set_free(set);
    return code;
}

tile_set tile_set_of_partition(const partition *from, const voxel_task *task)
{
    return (tile_set){.task = *task,
                      .tile = from->header.tile,
                      .tiles = tribox_tile_count(from->header.size, from->header.tile),
                      .records = from->list.tiles,
                      .count = from->list.count,
                      .places = from->list.places,
                      .from = from};
}

void tile_set_free(tile_set *set)
{
    pages_free(set->list, set->list ? set->starts[set->tiles] * sizeof *set->list : 0);
    free(set->starts);
    free(set->own_records);
    *set = (tile_set){.tile = 0};
}

/* The first record of a shard, counted from 0: that whose middle lies in it. */
static size_t first_record(const tile_set *set, uint32_t shard, uint32_t shards)
{
    double all = 0, before = 0;
    size_t r = 0;
    if (!shard)
        return 0;
    for (size_t i = 0; i < set->count; i++)
        all += (double)set->records[i].work;
    for (; r < set->count; r++) {
        const double work = (double)set->records[r].work;
        if (shards * (before + work / 2) / all >= shard)
            break;
        before += work;
    }
    return r;
}

void tile_set_shard(const tile_set *set, uint32_t shard, uint32_t shards, size_t *from, size_t *to)
{
    *from = first_record(set, shard - 1, shards);
    *to = shard < shards ? first_record(set, shard, shards) : set->count;
}

size_t tile_set_border(const tile_set *set, size_t from)
{
    return !from ? 0 : from < set->count ? (size_t)set->records[from].tile : set->tiles;
}

size_t tile_set_triangles(const tile_set *set, size_t record)
{
    const uint64_t end = record + 1 < set->count ? set->records[record + 1].first : set->places;
    return (size_t)(end - set->records[record].first);
}
