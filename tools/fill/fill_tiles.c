/* fill_tiles.c - the two ways of filling tile by tile. */
#define _POSIX_C_SOURCE 200809L
#include "fill_tiles.h"

#include <stdlib.h>

#include "beam.h"
#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "outside.h"
#include "parity_beams.h"

typedef struct beam_job {
    const beams *beams;
    const beam_filling *filling;
    const filled_sink *sink;
    progress *bar;
    beam_found found;
} beam_job;

/* Where a beam is filled. */
typedef struct beam_place {
    const beam_filling *filling;
    void *room;
    beam_solid solid;
    beam_found found;
} beam_place;

static void end_place(void *place)
{
    beam_place *const p = place;
    if (p->room)
        p->filling->end(p->room);
    free(p->solid.tiles);
    free(p);
}

static void *begin_place(void *data)
{
    const beam_job *const j = data;
    beam_place *const p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    p->filling = j->filling;
    p->solid.tiles = malloc(j->beams->tiles * sizeof *p->solid.tiles);
    p->room = p->solid.tiles ? j->filling->start(j->filling->about) : NULL;
    if (p->room)
        return p;
    end_place(p);
    return NULL;
}

static int fill_beam(void *data, void *place, size_t beam)
{
    const beam_job *const j = data;
    beam_place *const p = place;
    p->solid.count = 0;
    p->found = (beam_found){.bricks = 0};
    return (int)j->filling->fill(j->filling->about, p->room, beam, &p->solid, &p->found);
}

static int hand_on(void *data, void *place, size_t beam)
{
    beam_job *const j = data;
    beam_place *const p = place;
    for (size_t n = 0; n < p->solid.count; n++)
        if (tile_cells_cut(&p->solid.tiles[n], j->sink, &p->found.bricks))
            return TRIBOX_STOPPED;
    j->found.report.overlapping += p->found.report.overlapping;
    j->found.report.undecided += p->found.report.undecided;
    j->found.bricks += p->found.bricks;
    j->found.inside += p->found.inside;
    j->found.odd_rows += p->found.odd_rows;
    progress_tell(j->bar, (double)(beam + 1) / (double)j->beams->count);
    return 0;
}

/* sink: NULL to count alone. Returns what the filling or the sink ended with, or MESSAGE_NO_MEMORY. */
static tribox_status fill_beams(const beams *b, const beam_filling *filling, unsigned threads, const filled_sink *sink,
                                progress *bar, beam_found *found)
{
    const crew_work work = {.threads = threads,
                            .count = b->count,
                            .is_told_in_order = true,
                            .begin = begin_place,
                            .end = end_place,
                            .step = fill_beam,
                            .tell = hand_on};
    beam_job j = {.beams = b, .filling = filling, .sink = sink, .bar = bar};
    const int status = crew_do(&work, &j);
    *found = j.found;
    return (tribox_status)status;
}

static tribox_status fill_parity(const beams *b, const double x[2], unsigned threads, const filled_sink *sink, progress *bar,
                                 beam_found *found)
{
    parity p;
    tribox_status status = parity_start(b, x[0], x[1], &p);
    if (!status) {
        const beam_filling filling = parity_filling(&p);
        status = fill_beams(b, &filling, threads, sink, bar, found);
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
        status = fill_beams(b, &filling, threads, sink, bar, found);
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
