/* fill_tiles.c - the two ways of filling tile by tile. */
#define _POSIX_C_SOURCE 200809L
#include "fill_tiles.h"

#include <stdlib.h>

#include "beam.h"
#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"

static size_t along(const tile_set *set, int a)
{
    const uint32_t size = set->task.grid.size[a];
    return size / set->tile + (size % set->tile != 0);
}

static bool beams_of(const tile_set *set, fill_cells cells, beams *b)
{
    *b = (beams){.set = set, .tiles = along(set, 0), .count = along(set, 1) * along(set, 2), .cells = cells};
    b->first = malloc((b->count + 1) * sizeof *b->first);
    size_t record = 0;
    for (size_t n = 0; b->first && n <= b->count; n++) {
        while (record < set->count && set->records[record].tile < n * b->tiles)
            record++;
        b->first[n] = record;
    }
    return b->first;
}

typedef struct beam_job {
    const beams *beams;
    const beam_filling *filling;
    void *about;
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
    p->room = p->solid.tiles ? j->filling->start(j->about) : NULL;
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
    return (int)j->filling->fill(j->about, p->room, beam, &p->solid, &p->found);
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

static int fill_beams(beam_job *j, unsigned threads)
{
    const crew_work work = {.threads = threads,
                            .count = j->beams->count,
                            .is_told_in_order = true,
                            .begin = begin_place,
                            .end = end_place,
                            .step = fill_beam,
                            .tell = hand_on};
    return crew_do(&work, j);
}

tribox_status fill_tiles(const tile_set *set, const double x[2], fill_cells cells, unsigned threads, const filled_sink *sink,
                         progress *bar, beam_found *found)
{
    beams b;
    beam_job j = {.beams = &b, .filling = x ? &beam_parity : &beam_outside, .sink = sink, .bar = bar};
    *found = j.found;
    if (!beams_of(set, cells, &b))
        return MESSAGE_NO_MEMORY;
    int status = (int)j.filling->open(&b, x, threads, bar, &j.about);
    if (!status)
        status = fill_beams(&j, threads);
    j.filling->close(j.about);
    free(b.first);
    *found = j.found;
    return (tribox_status)status;
}
