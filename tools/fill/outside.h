/* outside.h - what the outside does not reach, tile by tile, in two passes over the tiles. */
#ifndef OUTSIDE_H
#define OUTSIDE_H

#include "beam.h"
#include "console/progress.h"
#include "outside_labels.h"

typedef struct outside {
    const beams *beams;
    outside_labels labels;
} outside;

/* The first pass: labels all tiles. In any case outside_end follows. */
tribox_status outside_start(const beams *b, unsigned threads, progress *bar, outside *o);
void outside_end(outside *o);

/* The second. */
beam_filling outside_filling(const outside *o);

#endif
