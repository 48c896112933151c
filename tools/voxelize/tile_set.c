/* tile_set.c - sorts triangles into tiles, and cuts tiles into shards. */
#include "tile_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/memory.h"
#include "console/message.h"
#include "tile_listing.h"
#include "tile_work.h"

uint32_t tile_set_side(const uint32_t size[3], bool has_ids)
{
    enum { SIDE = 128, SIDE_IDS = 64, SIDE_MOST = 1024 };
    static const size_t tiles_most = (size_t)1 << 24;
    uint32_t side = has_ids ? SIDE_IDS : SIDE;
    while (side <= SIDE_MOST && tribox_tile_count(size, side) > tiles_most)
        side *= 2;
    return side <= SIDE_MOST ? side : 0;
}

int tile_set_refuse_size(const uint32_t size[3])
{
    return message_failure("a grid of %u x %u x %u cells is too large even for tiles; choose fewer cells", size[0], size[1],
                           size[2]);
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
    const tribox_tiles all = {set->tile, 0, set->tiles};
    set->starts = take(set->tiles + 1, sizeof *set->starts, "table of tiles");
    if (!set->starts)
        return EXIT_CODE_FAILURE;
    const tribox_status status = tile_listing_make(&set->task, &all, &set->listing, threads, set->starts, &set->list);
    if (status == MESSAGE_NO_MEMORY)
        return message_failure("out of memory for the list of triangles by tile");
    set->places = status ? 0 : set->starts[set->tiles];
    return message_status(status);
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
    return !has_work || tile_work_estimate(set, set->own_records) ? EXIT_CODE_OK : message_failure("out of memory for the shards");
}

int tile_set_of_task(const voxel_task *task, bool has_work, unsigned threads, tile_set *set)
{
    *set = (tile_set){.task = *task, .tile = tile_set_side(task->grid.size, task->has_ids), .listing = *task->options};
    /* Shards are the same on every processor, and in sum the whole: only exact cells are not decided by which tiles are asked. */
    const bool is_exact = has_work || task->options->accuracy != TRIBOX_EXACT;
    set->listing.accuracy = is_exact ? TRIBOX_EXACT : TRIBOX_CONSERVATIVE;
    if (!set->tile)
        return tile_set_refuse_size(task->grid.size);
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
                      .records = from->tiles,
                      .count = from->header.records,
                      .places = from->header.places,
                      .from = from};
}

void tile_set_free(tile_set *set)
{
    if (set->list)
        tile_listing_free(set->list, set->starts[set->tiles]);
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
