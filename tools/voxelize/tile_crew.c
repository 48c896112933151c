/* tile_crew.c - threads that take a few tiles in turn, and hand on their bricks in the order of the tiles. */
#define _POSIX_C_SOURCE 200809L
#include "tile_crew.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "console/memory.h"
#include "console/message.h"
#include "console/pages.h"
#include "tile_set.h"
#include "write/voxels.h"

typedef struct kept_brick {
    uint32_t at[3];
    uint64_t bits[8];
} kept_brick;

typedef struct kept_bricks {
    kept_brick *bricks;
    size_t count, room;
    uint32_t *ids; /* one brick's after another's */
    size_t ids_count, ids_room;
} kept_bricks;

/* How much they take, counted in bricks. */
static inline size_t kept_bricks_size(const kept_bricks *kept)
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

/* A tile_sink's take, of kept_bricks. It stops where there is no memory. */
static int kept_bricks_take(void *kept, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    kept_bricks *const k = kept;
    kept_brick *const grown = memory_grow_pages(k->bricks, k->count + 1, &k->room, sizeof *grown);
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

static void kept_bricks_free(kept_bricks *kept)
{
    pages_free(kept->bricks, kept->room * sizeof *kept->bricks);
    pages_free(kept->ids, kept->ids_room * sizeof *kept->ids);
}

/* A share ends with the tile that fills it: little enough to keep, and enough to be worth a lock. */
enum { SHARE_TRIANGLES = 2048, SHARE_TILES = 4 };

/* Shares for each thread that may be taken before their turn, as some take longer, and how many bricks may wait for theirs. */
enum { AHEAD = 4, WAITING_MOST = 1 << 19 };

typedef struct share {
    size_t number, from, to;
} share;

/* A share that was taken, by what its number leaves. */
typedef struct slot {
    share share;
    kept_bricks kept;
    tribox_report report;
    bool is_done;
} slot;

typedef struct crew {
    const tile_set *set;
    size_t from, to;
    tile_room *room;       /* of the calling thread */
    bool is_direct;        /* one thread, or none that waits */
    const tile_sink *sink; /* NULL to count */
    progress *bar;
    slot *slots;
    size_t ahead;         /* slots */
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t turned;
    kept_bricks *spare; /* memory of shares that were handed on: the last is taken first, as caches have it */
    size_t spares;
    size_t next;         /* record of the next share */
    size_t number, turn; /* shares taken, and handed on */
    size_t waiting;      /* bricks in slots that are done, or as much of ids */
    bool is_handing;     /* a thread hands bricks to the sink */
    size_t done;         /* records */
    tile_found found;
    tribox_status status; /* the first that is not OK ends the work */
} crew;

/* Whoever takes the share whose turn it is does not wait, nor who hands on: there is always one at work. */
static bool is_far_ahead(const crew *c)
{
    const size_t taken = c->number - c->turn;
    return !c->status && !c->is_direct && taken && (taken >= c->ahead || c->waiting > WAITING_MOST);
}

/* False where nothing is left. */
static bool take_share(crew *c, share *s)
{
    pthread_mutex_lock(&c->lock);
    size_t triangles = 0;
    while (is_far_ahead(c))
        pthread_cond_wait(&c->turned, &c->lock);
    *s = (share){c->number, c->next, c->next};
    while (!c->status && s->to < c->to && s->to - s->from < SHARE_TILES && triangles < SHARE_TRIANGLES)
        triangles += tile_set_triangles(c->set, s->to++);
    c->next = s->to;
    c->number += s->to > s->from;
    if (s->to > s->from && c->spares)
        c->slots[s->number % c->ahead].kept = c->spare[--c->spares];
    pthread_mutex_unlock(&c->lock);
    return s->to > s->from;
}

/* A sink that counts what it is handed, and hands it on where there is another. */
typedef struct counter {
    const tile_sink *sink;
    uint64_t bricks;
} counter;

static int count_brick(void *data, const uint32_t at[3], const uint64_t bits[8], const uint32_t *ids)
{
    counter *const n = data;
    n->bricks++;
    return n->sink ? n->sink->take(n->sink->data, at, bits, ids) : 0;
}

/* Under the lock: a share is through. */
static void account(crew *c, const share *s, tribox_status status, const tribox_report *report, uint64_t bricks)
{
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
}

/* Under the lock, which is left meanwhile: all shares that are done and whose turn it is. */
static void hand_on(crew *c)
{
    c->is_handing = true;
    for (slot *s; !c->status && (s = &c->slots[c->turn % c->ahead])->is_done;) {
        pthread_mutex_unlock(&c->lock);
        const tribox_status status = kept_bricks_hand_on(&s->kept, c->sink);
        pthread_mutex_lock(&c->lock);
        s->is_done = false;
        c->waiting -= kept_bricks_size(&s->kept);
        account(c, &s->share, status, &s->report, s->kept.count);
        c->spare[c->spares++] = s->kept;
        s->kept = (kept_bricks){.count = 0};
    }
    c->is_handing = false;
    pthread_cond_broadcast(&c->turned);
}

/* Straight into the sink, or counted. */
static void run_at_once(crew *c, const share *s, tile_room *room)
{
    tribox_report report = {0, 0};
    counter n = {.sink = c->sink};
    const tribox_status status = tile_set_run(c->set, s->from, s->to, room, &(tile_sink){count_brick, &n}, &report);
    pthread_mutex_lock(&c->lock);
    account(c, s, status, &report, n.bricks);
    pthread_mutex_unlock(&c->lock);
}

/* Without memory to keep its bricks a share is done again in its turn, straight into the sink. */
static void run_again(crew *c, const share *s, tile_room *room)
{
    pthread_mutex_lock(&c->lock);
    while ((c->turn < s->number || c->is_handing) && !c->status)
        pthread_cond_wait(&c->turned, &c->lock);
    const bool goes_on = !c->status;
    c->is_handing |= goes_on;
    pthread_mutex_unlock(&c->lock);
    if (!goes_on)
        return;
    run_at_once(c, s, room);
    pthread_mutex_lock(&c->lock);
    hand_on(c);
    pthread_mutex_unlock(&c->lock);
}

/* Kept until its turn comes; whoever is done with a share whose turn it is hands it on, and what is done after it. */
static void run_in_turn(crew *c, const share *s, tile_room *room)
{
    slot *const own = &c->slots[s->number % c->ahead];
    own->share = *s;
    own->kept.count = own->kept.ids_count = 0;
    const tribox_status status =
        tile_set_run(c->set, s->from, s->to, room, &(tile_sink){kept_bricks_take, &own->kept}, &own->report);
    if (status == TRIBOX_STOPPED) {
        run_again(c, s, room);
        return;
    }
    pthread_mutex_lock(&c->lock);
    own->is_done = !status;
    c->waiting += kept_bricks_size(&own->kept);
    if (status && !c->status)
        c->status = status;
    if (!c->is_handing)
        hand_on(c);
    pthread_mutex_unlock(&c->lock);
}

/* Whoever has no memory takes no share; of the calling thread it is there. */
static void work(void *data, unsigned thread)
{
    crew *const c = data;
    tile_room *const room = thread ? tile_room_new(c->set, c->from, c->to) : c->room;
    for (share s; room && take_share(c, &s);)
        if (c->is_direct)
            run_at_once(c, &s, room);
        else
            run_in_turn(c, &s, room);
    if (thread)
        tile_room_free(room);
}

tribox_status tile_crew_run(const tile_set *set, size_t from, size_t to, unsigned threads, const tile_sink *sink, progress *bar,
                            tile_found *found)
{
    const size_t most = to - from ? to - from : 1;
    crew c = {.set = set, .from = from, .to = to, .is_direct = threads == 1 || !sink, .sink = sink, .bar = bar, .next = from};
    *found = c.found;
    c.ahead = c.is_direct ? 0 : AHEAD * (size_t)threads;
    c.slots = calloc(c.ahead + 1, sizeof *c.slots);
    c.spare = calloc(c.ahead + 1, sizeof *c.spare);
    c.room = c.slots && c.spare ? tile_room_new(set, from, to) : NULL;
    const bool has_memory = c.room;
    pthread_mutex_init(&c.lock, NULL);
    pthread_cond_init(&c.turned, NULL);
    if (has_memory)
        crew_run(threads < most ? threads : (unsigned)most, work, &c);
    pthread_cond_destroy(&c.turned);
    pthread_mutex_destroy(&c.lock);
    for (size_t n = 0; n < c.ahead && c.slots; n++)
        kept_bricks_free(&c.slots[n].kept);
    for (size_t n = 0; n < c.spares; n++)
        kept_bricks_free(&c.spare[n]);
    tile_room_free(c.room);
    free(c.slots);
    free(c.spare);
    *found = c.found;
    return has_memory ? c.status : MESSAGE_NO_MEMORY;
}
