/* beam_crew.c - threads that take beams in turn, and hand on the bricks of each when it is its turn. */
#define _POSIX_C_SOURCE 200809L
#include "beam_crew.h"

#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"

typedef struct crew {
    const beams *beams;
    const beam_filling *filling;
    const filled_sink *sink;
    progress *bar;
    pthread_mutex_t lock; /* of what follows */
    pthread_cond_t turned;
    size_t next, turn; /* beams that were taken, and handed on */
    beam_found found;
    tribox_status status; /* the first that is not OK ends the work */
} crew;

static bool take_beam(crew *c, size_t *beam)
{
    pthread_mutex_lock(&c->lock);
    const bool is_left = !c->status && c->next < c->beams->count;
    *beam = c->next;
    c->next += is_left;
    pthread_mutex_unlock(&c->lock);
    return is_left;
}

/* Returns whether the work goes on. */
static bool wait_turn(crew *c, size_t beam)
{
    pthread_mutex_lock(&c->lock);
    while (c->turn < beam && !c->status)
        pthread_cond_wait(&c->turned, &c->lock);
    const bool goes_on = !c->status;
    pthread_mutex_unlock(&c->lock);
    return goes_on;
}

static void account(crew *c, tribox_status status, const beam_found *found)
{
    pthread_mutex_lock(&c->lock);
    if (status && !c->status)
        c->status = status;
    c->turn++;
    c->found.report.overlapping += found->report.overlapping;
    c->found.report.undecided += found->report.undecided;
    c->found.bricks += found->bricks;
    c->found.inside += found->inside;
    c->found.odd_rows += found->odd_rows;
    if (!status)
        progress_tell(c->bar, (double)c->turn / (double)c->beams->count);
    pthread_cond_broadcast(&c->turned);
    pthread_mutex_unlock(&c->lock);
}

/* Without a sink there is nothing to wait for, but turns are counted. */
static void run_beam(crew *c, size_t beam, void *room, beam_solid *solid)
{
    beam_found found = {.bricks = 0};
    solid->count = 0;
    tribox_status status = c->filling->fill(c->filling->about, room, beam, solid, &found);
    if (!status && (!c->sink || wait_turn(c, beam)))
        for (size_t n = 0; n < solid->count && !status; n++)
            status = tile_cells_cut(&solid->tiles[n], c->sink, &found.bricks) ? TRIBOX_STOPPED : TRIBOX_OK;
    account(c, status, &found);
}

static void no_memory(crew *c, unsigned thread)
{
    pthread_mutex_lock(&c->lock);
    if (!thread && !c->status)
        c->status = MESSAGE_NO_MEMORY;
    pthread_cond_broadcast(&c->turned);
    pthread_mutex_unlock(&c->lock);
}

/* Threads for which there is no memory leave the work to the others; the first is to have it. */
static void work(void *data, unsigned thread)
{
    crew *const c = data;
    beam_solid solid = {.tiles = malloc(c->beams->tiles * sizeof *solid.tiles)};
    void *const room = solid.tiles ? c->filling->start(c->filling->about) : NULL;
    if (!room)
        no_memory(c, thread);
    for (size_t beam; room && take_beam(c, &beam);)
        run_beam(c, beam, room, &solid);
    if (room)
        c->filling->end(room);
    free(solid.tiles);
}

tribox_status beam_crew_run(const beams *b, const beam_filling *filling, unsigned threads, const filled_sink *sink, progress *bar,
                            beam_found *found)
{
    crew c = {.beams = b, .filling = filling, .sink = sink, .bar = bar};
    pthread_mutex_init(&c.lock, NULL);
    pthread_cond_init(&c.turned, NULL);
    crew_run(threads, work, &c);
    pthread_cond_destroy(&c.turned);
    pthread_mutex_destroy(&c.lock);
    *found = c.found;
    return c.status;
}
