/* tile_crew.c - threads that take a few tiles in turn, and hand on their bricks in the order of the tiles. */
#define _POSIX_C_SOURCE 200809L
#include "tile_crew.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/message.h"

/* A share ends with the tile that fills it: little enough to keep, and enough to be worth a lock. */
enum { SHARE_TRIANGLES = 4096, SHARE_TILES = 16 };

typedef struct kept_brick {
    uint32_t at[3];
    uint64_t bits[8];
} kept_brick;

/* The bricks of a share until its turn comes. */
typedef struct kept {
    kept_brick *bricks;
    size_t count, room;
} kept;

typedef struct crew {
    const tile_set *set;
    size_t from, to;
    tile_room *room; /* of the calling thread */
    bool is_alone;
    const tribox_sink *sink; /* NULL to count */
    progress *bar;
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t turned;
    size_t next;         /* record of the next share */
    size_t number, turn; /* shares taken, and handed on */
    size_t done;         /* records */
    tile_found found;
    tribox_status status; /* the first that is not OK ends the work */
} crew;

typedef struct share {
    size_t number, from, to;
} share;

/* False where nothing is left. */
static bool take_share(crew *c, share *s)
{
    pthread_mutex_lock(&c->lock);
    size_t triangles = 0;
    *s = (share){c->number, c->next, c->next};
    while (!c->status && s->to < c->to && s->to - s->from < SHARE_TILES && triangles < SHARE_TRIANGLES)
        triangles += tile_set_triangles(c->set, s->to++);
    c->next = s->to;
    c->number += s->to > s->from;
    pthread_mutex_unlock(&c->lock);
    return s->to > s->from;
}

static int count_brick(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at, (void)bits;
    ++*(uint64_t *)data;
    return 0;
}

/* The sink of a crew of one, and how many it was handed. */
typedef struct direct {
    const crew *crew;
    uint64_t bricks;
} direct;

static int pass_brick(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    direct *const d = data;
    d->bricks++;
    return d->crew->sink->take(d->crew->sink->data, at, bits);
}

static int keep_brick(void *data, const uint32_t at[3], const uint64_t bits[8])
{
    kept *const k = data;
    if (k->count == k->room) {
        const size_t room = k->room ? 2 * k->room : 1024;
        kept_brick *const grown = realloc(k->bricks, room * sizeof *grown);
        if (!grown)
            return 1;
        k->bricks = grown;
        k->room = room;
    }
    kept_brick *const to = &k->bricks[k->count++];
    memcpy(to->at, at, sizeof to->at);
    memcpy(to->bits, bits, sizeof to->bits);
    return 0;
}

static tribox_status emit_kept(const crew *c, const kept *k)
{
    size_t i = 0;
    while (i < k->count && !c->sink->take(c->sink->data, k->bricks[i].at, k->bricks[i].bits))
        i++;
    return i == k->count ? TRIBOX_OK : TRIBOX_STOPPED;
}

/* Waits until all shares before this one have been handed on. Returns whether the work goes on. */
static bool wait_turn(crew *c, const share *s)
{
    pthread_mutex_lock(&c->lock);
    while (c->turn < s->number && !c->status)
        pthread_cond_wait(&c->turned, &c->lock);
    const bool goes_on = !c->status;
    pthread_mutex_unlock(&c->lock);
    return goes_on;
}

static void account(crew *c, const share *s, tribox_status status, const tribox_report *report, uint64_t bricks)
{
    pthread_mutex_lock(&c->lock);
    if (status && !c->status)
        c->status = status;
    c->turn++;
    c->done += s->to - s->from;
    c->found.report.overlapping += report->overlapping;
    c->found.report.undecided += report->undecided;
    c->found.bricks += bricks;
    if (!status)
        progress_tell(c->bar, (double)c->done / (double)(c->to - c->from));
    pthread_cond_broadcast(&c->turned);
    pthread_mutex_unlock(&c->lock);
}

/* Straight into the sink, or counted. */
static tribox_status run_directly(const crew *c, const share *s, tile_room *room, tribox_report *report, uint64_t *bricks)
{
    direct d = {c, 0};
    const tribox_sink sink = c->sink ? (tribox_sink){pass_brick, &d} : (tribox_sink){count_brick, bricks};
    const tribox_status status = tile_set_run(c->set, s->from, s->to, room, &sink, report);
    if (c->sink)
        *bricks = d.bricks;
    return status;
}

/* Kept, and handed on in turn. Without memory to keep them it is done again in turn, straight into the sink. */
static tribox_status run_in_turn(crew *c, const share *s, tile_room *room, kept *k, tribox_report *report, uint64_t *bricks)
{
    k->count = 0;
    tribox_status status = tile_set_run(c->set, s->from, s->to, room, &(tribox_sink){keep_brick, k}, report);
    const bool is_full = status == TRIBOX_STOPPED;
    *bricks = k->count;
    if ((!status || is_full) && wait_turn(c, s))
        status = is_full ? run_directly(c, s, room, report, bricks) : emit_kept(c, k);
    return status;
}

static void run_share(crew *c, const share *s, tile_room *room, kept *k)
{
    tribox_report report = {0, 0};
    uint64_t bricks = 0;
    const bool is_direct = c->is_alone || !c->sink;
    const tribox_status status =
        is_direct ? run_directly(c, s, room, &report, &bricks) : run_in_turn(c, s, room, k, &report, &bricks);
    account(c, s, status, &report, bricks);
}

/* Whoever has no memory takes no share; of the calling thread it is there. */
static void work(void *data, unsigned thread)
{
    crew *const c = data;
    tile_room *const room = thread ? tile_room_new(c->set, c->from, c->to) : c->room;
    kept k = {.bricks = NULL};
    for (share s; room && take_share(c, &s);)
        run_share(c, &s, room, &k);
    free(k.bricks);
    if (thread)
        tile_room_free(room);
}

tribox_status tile_crew_run(const tile_set *set, size_t from, size_t to, unsigned threads, const tribox_sink *sink, progress *bar,
                            tile_found *found)
{
    const size_t most = to - from ? to - from : 1;
    crew c = {.set = set, .from = from, .to = to, .is_alone = threads == 1, .sink = sink, .bar = bar, .next = from};
    c.room = tile_room_new(set, from, to);
    *found = c.found;
    if (!c.room)
        return MESSAGE_NO_MEMORY;
    pthread_mutex_init(&c.lock, NULL);
    pthread_cond_init(&c.turned, NULL);
    crew_run(threads < most ? threads : (unsigned)most, work, &c);
    tile_room_free(c.room);
    pthread_cond_destroy(&c.turned);
    pthread_mutex_destroy(&c.lock);
    *found = c.found;
    return c.status;
}
