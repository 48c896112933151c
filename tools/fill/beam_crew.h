/* beam_crew.h - beams filled by several threads, whose bricks come in the order of tiles. */
#ifndef BEAM_CREW_H
#define BEAM_CREW_H

#include "beam.h"
#include "console/progress.h"

/* sink: NULL to count alone. Returns what the filling or the sink ended with, or MESSAGE_NO_MEMORY. */
tribox_status beam_crew_run(const beams *b, const beam_filling *filling, unsigned threads, const filled_sink *sink, progress *bar,
                            beam_found *found);

#endif
