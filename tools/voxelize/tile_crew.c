/* tile_crew.c - threads that take a few tiles in turn, and hand on their bricks in the order of the tiles. */
#define _POSIX_C_SOURCE 200809L
#include "tile_set.h"

#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/system.h"
#include "write/voxels.h"

typedef struct kept_brick {
    uint32_t at[3];
    uint64_t bits[8];
} kept_brick;

typedef struct kept_bricks {
    kept_brick *bricks;
    size_t count, room, most; /* most: of what kept_size counts */
    uint32_t *ids;            /* one brick's after another's */
    size_t ids_count, ids_room;
} kept_bricks;

/* How much they take, counted in bricks. */
static size_t kept_size(const kept_bricks *kept)
{
    return kept->count + kept->ids_count * sizeof *kept->ids / sizeof *kept->bricks;
}

static bool keep_ids(kept_bricks *k, const uint32_t *ids, size_t cells)
{
    uint32_t *const grown = memory_grow_pages(k->ids, k->ids_count + cells, &k->ids_room, sizeof *ids);
    if (!grown)
        return false;
    k->ids = grown;
    memcpy(k->ids + k->ids_count, ids, cells * sizeof *ids);
    k->ids_count += cells;
    return true;
}

/* A tile_sink's take, of kept_bricks. It stops where there is no memory, or too much to keep. */
static int kept_bricks_take(void *kept, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    kept_bricks *const k = kept;
    kept_brick *const grown = kept_size(k) > k->most ? NULL : memory_grow_pages(k->bricks, k->count + 1, &k->room, sizeof *grown);
    if (!grown)
        return 1;
    k->bricks = grown;
    if (ids && !keep_ids(k, ids, (size_t)voxels_count(bits, 8)))
        return 1;
    kept_brick *const to = &k->bricks[k->count++];
    memcpy(to->at, at, sizeof to->at);
    memcpy(to->bits, bits, sizeof to->bits);
    return 0;
}

/* Returns TRIBOX_STOPPED if the sink stopped. */
static tribox_status kept_bricks_hand_on(const kept_bricks *kept, const tile_sink *sink)
{
    const uint32_t *ids = kept->ids_count ? kept->ids : NULL;
    for (size_t i = 0; i < kept->count; i++) {
        const kept_brick *const b = &kept->bricks[i];
        if (sink->take(sink->data, b->at, b->bits, ids))
            return TRIBOX_STOPPED;
        if (ids)
            ids += voxels_count(b->bits, 8);
    }
    return TRIBOX_OK;
}

/* A share ends with the tile that fills it: little enough to keep, and enough to be worth a lock. */
enum { SHARE_TRIANGLES = 2048, SHARE_TILES = 4 };

/* Shares for each thread that may wait for their turn, as some take longer, and how many bricks may wait in all of them. */
enum { AHEAD = 4, WAITING_MOST = 1 << 19, KEPT_LEAST = 1 << 12 };

typedef struct tile_job {
    const tile_set *set;
    size_t from, to, next; /* records: of all, and of the next share */
    bool is_direct;        /* one thread, or none that waits */
    size_t kept_most;      /* bricks of a share that wait */
    const tile_sink *sink; /* NULL to count */
    progress *bar;
    size_t done; /* records */
    tile_found found;
} tile_job;

/* A share, and where it is voxelized. */
typedef struct share {
    const tile_job *job;
    tile_room *room;
    size_t from, to;
    kept_bricks kept;
    bool is_kept; /* else it is to be done in its turn */
    tile_found found;
} share;

static void end_share(void *place)
{
    share *const s = place;
    pages_free(s->kept.bricks, s->kept.room * sizeof *s->kept.bricks);
    pages_free(s->kept.ids, s->kept.ids_room * sizeof *s->kept.ids);
    tile_room_free(s->room);
}

static bool begin_share(void *data, void *place)
{
    const tile_job *const j = data;
    share *const s = place;
    s->job = j;
    s->kept.most = j->kept_most;
    return (s->room = tile_room_new(j->set, j->from, j->to)) != NULL;
}

static bool find_share(void *data, void *place, size_t n)
{
    tile_job *const j = data;
    share *const s = place;
    size_t triangles = 0;
    (void)n;
    s->from = s->to = j->next;
    while (s->to < j->to && s->to - s->from < SHARE_TILES && triangles < SHARE_TRIANGLES)
        triangles += tile_set_triangles(j->set, s->to++);
    j->next = s->to;
    return s->to > s->from;
}

static int count_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    share *const s = data;
    const tile_sink *const sink = s->job->sink;
    s->found.bricks++;
    return sink ? sink->take(sink->data, at, bits, ids) : 0;
}

/* Straight into the sink, or counted. */
static int run_at_once(share *s)
{
    s->found.bricks = 0;
    return (int)tile_set_run(s->job->set, s->from, s->to, s->room, &(tile_sink){count_brick, s}, &s->found.report);
}

static int run_share(void *data, void *place, size_t n)
{
    const tile_job *const j = data;
    share *const s = place;
    (void)n;
    s->is_kept = !j->is_direct;
    s->kept.count = s->kept.ids_count = 0;
    if (j->is_direct)
        return run_at_once(s);
    const tribox_status status =
        tile_set_run(j->set, s->from, s->to, s->room, &(tile_sink){kept_bricks_take, &s->kept}, &s->found.report);
    s->is_kept = status != TRIBOX_STOPPED;
    s->found.bricks = s->kept.count;
    return s->is_kept ? (int)status : 0;
}

/* Without memory to keep its bricks a share is done again in its turn, straight into the sink. */
static int tell_share(void *data, void *place, size_t n)
{
    tile_job *const j = data;
    share *const s = place;
    const int status = j->is_direct ? 0 : s->is_kept ? (int)kept_bricks_hand_on(&s->kept, j->sink) : run_at_once(s);
    (void)n;
    if (status)
        return status;
    j->done += s->to - s->from;
    j->found.report.overlapping += s->found.report.overlapping;
    j->found.report.undecided += s->found.report.undecided;
    j->found.bricks += s->found.bricks;
    progress_tell(j->bar, (double)j->done / (double)(j->to - j->from));
    return 0;
}

tribox_status tile_crew_run(const tile_set *set, size_t from, size_t to, unsigned threads, const tile_sink *sink, progress *bar,
                            tile_found *found)
{
    const size_t fair = WAITING_MOST / AHEAD / threads;
    tile_job j = {.set = set, .from = from, .to = to, .next = from, .is_direct = threads == 1 || !sink, .sink = sink, .bar = bar};
    j.kept_most = fair < KEPT_LEAST ? KEPT_LEAST : fair;
    const crew_work work = {.threads = to - from < threads ? (unsigned)(to - from) : threads,
                            .each = j.is_direct ? 1 : AHEAD,
                            .is_told_in_order = !j.is_direct,
                            .place_bytes = sizeof(share),
                            .begin = begin_share,
                            .end = end_share,
                            .find = find_share,
                            .step = run_share,
                            .tell = tell_share};
    const int status = crew_do(&work, &j);
    *found = j.found;
    return (tribox_status)status;
}
