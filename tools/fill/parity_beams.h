/* parity_beams.h - parity of the crossings of rays along x, beam by beam: a window of whole rows at a time. */
#ifndef PARITY_BEAMS_H
#define PARITY_BEAMS_H

#include "beam.h"

typedef struct parity {
    const beams *beams;
    size_t *starts; /* of the list of each beam */
    uint32_t *list; /* triangles that its rays may cross, before and behind the grid too */
} parity;

/* lo, hi: the bounds of the mesh along x. */
tribox_status parity_start(const beams *b, double lo, double hi, parity *p);
void parity_end(parity *p);

beam_filling parity_filling(const parity *p);

#endif
