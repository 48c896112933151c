/* fill_tiles.c - the two ways of filling tile by tile. */
#define _POSIX_C_SOURCE 200809L
#include "fill_tiles.h"

#include <pthread.h>
#include <stdlib.h>

#include "beam.h"
#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "outside.h"
#include "parity_beams.h"

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

/* sink: NULL to count alone. Returns what the filling or the sink ended with, or MESSAGE_NO_MEMORY. */
static tribox_status beam_crew_run(const beams *b, const beam_filling *filling, unsigned threads, const filled_sink *sink,
                                   progress *bar, beam_found *found)
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

static tribox_status fill_parity(const beams *b, const double x[2], unsigned threads, const filled_sink *sink, progress *bar,
                                 beam_found *found)
{
    parity p;
    tribox_status status = parity_start(b, x[0], x[1], &p);
    if (!status) {
        const beam_filling filling = parity_filling(&p);
        status = beam_crew_run(b, &filling, threads, sink, bar, found);
    }
    parity_end(&p);
    return status;
}

static tribox_status fill_outside(const beams *b, unsigned threads, const filled_sink *sink, progress *bar, beam_found *found)
{
    outside o;
    tribox_status status = outside_start(b, threads, bar, &o);
    if (!status) {
        const beam_filling filling = outside_filling(&o);
        status = beam_crew_run(b, &filling, threads, sink, bar, found);
    }
    outside_end(&o);
    return status;
}

tribox_status fill_tiles(const tile_set *set, const double x[2], fill_cells cells, unsigned threads, const filled_sink *sink,
                         progress *bar, beam_found *found)
{
    beams b;
    *found = (beam_found){.bricks = 0};
    if (!beams_of(set, cells, &b))
        return MESSAGE_NO_MEMORY;
    const tribox_status status = x ? fill_parity(&b, x, threads, sink, bar, found) : fill_outside(&b, threads, sink, bar, found);
    beams_free(&b);
    return status;
}
