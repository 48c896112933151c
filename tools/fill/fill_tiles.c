/* fill_tiles.c - the two ways of filling tile by tile. */
#include "fill_tiles.h"

#include "beam_crew.h"
#include "console/message.h"
#include "outside.h"
#include "parity_beams.h"

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
