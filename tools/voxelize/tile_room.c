/* tile_room.c - hands tiles to the library: of a mesh, or of partitions, whose triangles are read and checked before. */
#include <stdlib.h>

#include "console/system.h"
#include "tile_set.h"
#include "write/voxels.h"

/* Tiles of a partition go to the library some at a time, as each call clears the scratch. */
enum { BATCH_TRIANGLES = 4096, BATCH_TILES = 256 };

struct tile_room {
    void *scratch;
    size_t scratch_bytes;
    size_t most;                    /* triangles of a partition at once */
    uint32_t *list;                 /* 0, 1, 2, ... */
    unsigned char *triangles;       /* so many */
    uint32_t *numbers;              /* theirs, where they have some */
    size_t starts[BATCH_TILES + 1]; /* of the tiles of a batch */
};

static size_t triangle_bytes(const tile_set *set)
{
    enum { NUMBERS = 9 };
    return NUMBERS * (size_t)set->from->header.position_bytes;
}

static bool make_list(const tile_set *set, size_t from, size_t to, tile_room *room)
{
    room->most = BATCH_TRIANGLES;
    for (size_t r = from; r < to; r++)
        if (tile_set_triangles(set, r) > room->most)
            room->most = tile_set_triangles(set, r);
    const bool has_numbers = set->from->header.number_bytes;
    room->list = malloc(room->most * sizeof *room->list);
    for (size_t i = 0; room->list && i < room->most; i++)
        room->list[i] = (uint32_t)i;
    room->triangles = malloc(room->most * triangle_bytes(set));
    if (has_numbers)
        room->numbers = malloc(room->most * sizeof *room->numbers);
    return room->list && room->triangles && (room->numbers || !has_numbers);
}

tile_room *tile_room_new(const tile_set *set, size_t from, size_t to)
{
    tile_room *const room = calloc(1, sizeof *room);
    if (!room)
        return NULL;
    room->scratch_bytes = set->task.has_ids ? tribox_bricks_ids_bytes(set->tile) : tribox_bricks_bytes(set->tile);
    room->scratch = pages_take(room->scratch_bytes);
    if (room->scratch && (!set->from || make_list(set, from, to, room)))
        return room;
    tile_room_free(room);
    return NULL;
}

void tile_room_free(tile_room *room)
{
    if (!room)
        return;
    pages_free(room->scratch, room->scratch_bytes);
    free(room->list);
    free(room->triangles);
    free(room->numbers);
    free(room);
}

static int take_brick(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    const tile_sink *const sink = data;
    return sink->take(sink->data, at, bits, NULL);
}

/* The sink of bricks with ids, which are places in a batch of a partition where that has numbers. */
typedef struct ids_taker {
    const tile_sink *sink;
    const uint32_t *numbers;
} ids_taker;

static int take_ids(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    const ids_taker *const taker = data;
    uint32_t of_cells[512], *to = of_cells;
    for (unsigned k = 0; k < 8; k++)
        for (uint64_t word = bits[k]; word; word &= word - 1) {
            const uint32_t id = ids[64 * k + lowest_bit(word)];
            *to++ = taker->numbers ? taker->numbers[id] : id;
        }
    return taker->sink->take(taker->sink->data, at, bits, of_cells);
}

/* Some tiles of the triangles of a task: of these lists, and with these numbers where they are not NULL. */
static tribox_status run_lists(const voxel_task *t, const tribox_tiles *tiles, const size_t *starts, const uint32_t *list,
                               const uint32_t *numbers, void *scratch, const tile_sink *to, tribox_report *report)
{
    tile_sink own = *to;
    const tribox_sink sink = {take_brick, &own};
    ids_taker taker = {to, numbers};
    const tribox_ids_sink ids = {take_ids, &taker};
    if (t->has_ids)
        return t->soup ? tribox_bricks_ids(t->soup, &t->grid, tiles, starts, list, t->options, scratch, &ids, report)
                       : tribox_mesh_bricks_ids(t->mesh, &t->grid, tiles, starts, list, t->options, scratch, &ids, report);
    return t->soup ? tribox_bricks(t->soup, &t->grid, tiles, starts, list, t->options, scratch, &sink, report)
                   : tribox_mesh_bricks(t->mesh, &t->grid, tiles, starts, list, t->options, scratch, &sink, report);
}

/* Records from .. to - 1 of a partition, whose triangles lie one after the other. */
typedef struct batch {
    size_t from, to;
    size_t first, end; /* tiles */
    tribox_mesh mesh;
} batch;

static batch take_batch(const tile_set *set, size_t from, size_t to, const tile_room *room)
{
    batch b = {.from = from, .to = from, .first = (size_t)set->records[from].tile};
    while (b.to < to && set->records[b.to].tile - b.first < BATCH_TILES &&
           b.mesh.count + tile_set_triangles(set, b.to) <= room->most)
        b.mesh.count += tile_set_triangles(set, b.to++);
    b.end = (size_t)set->records[b.to - 1].tile + 1;
    b.mesh.positions = room->triangles;
    b.mesh.vertices = 3 * b.mesh.count;
    b.mesh.position_bytes = set->from->header.position_bytes;
    return b;
}

/* Where the list of each tile begins, among those of the batch. */
static void set_starts(const tile_set *set, const batch *b, size_t *starts)
{
    size_t r = b->from, before = 0;
    for (size_t t = b->first; t < b->end; t++) {
        starts[t - b->first] = before;
        if (set->records[r].tile == t)
            before += tile_set_triangles(set, r++);
    }
    starts[b->end - b->first] = before;
}

/* False where some are not what they were. */
static bool read_batch(const tile_set *set, const batch *b, tile_room *room)
{
    size_t before = 0, r = b->from;
    for (; r < b->to; before += tile_set_triangles(set, r++))
        if (!partition_read(set->from, r, room->triangles + before * triangle_bytes(set),
                            room->numbers ? room->numbers + before : NULL))
            return false;
    return true;
}

static tribox_status run_batch(const tile_set *set, const batch *b, tile_room *room, const tile_sink *to, tribox_report *report)
{
    const tribox_tiles tiles = {set->tile, b->first, b->end - b->first};
    voxel_task task = set->task;
    task.soup = NULL;
    task.mesh = &b->mesh;
    set_starts(set, b, room->starts);
    return read_batch(set, b, room) ? run_lists(&task, &tiles, room->starts, room->list, room->numbers, room->scratch, to, report)
                                    : TRIBOX_BAD_VERTEX;
}

tribox_status tile_set_run(const tile_set *set, size_t from, size_t to, tile_room *room, const tile_sink *sink,
                           tribox_report *report)
{
    tribox_status status = TRIBOX_OK;
    *report = (tribox_report){0, 0};
    if (from == to)
        return TRIBOX_OK;
    if (!set->from) {
        const size_t first = (size_t)set->records[from].tile, last = (size_t)set->records[to - 1].tile;
        const tribox_tiles tiles = {set->tile, first, last - first + 1};
        return run_lists(&set->task, &tiles, set->starts + first, set->list, NULL, room->scratch, sink, report);
    }
    for (batch b = {.to = from}; !status && b.to < to;) {
        tribox_report one = {0, 0};
        b = take_batch(set, b.to, to, room);
        status = run_batch(set, &b, room, sink, &one);
        report->overlapping += one.overlapping;
        report->undecided += one.undecided;
    }
    return status;
}
