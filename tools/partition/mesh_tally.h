/* mesh_tally.h - what a mesh that is read in pieces is like: its bounds, and what its header counts. */
#ifndef MESH_TALLY_H
#define MESH_TALLY_H

#include "piece.h"
#include "write/checksum.h"

typedef struct tally {
    tribox_box bounds;              /* of the triangles that are finite; lo > hi where there are none */
    uint64_t triangles, not_finite; /* as far as they were looked at */
    uint64_t first_not_finite;      /* the number of the first of them */
    mesh_sums sums;
    bool fits_float; /* no number is lost as a float */
} tally;

/* Of no triangles, and of two runs of them together. */
tally tally_of_none(void);
void tally_add(tally *to, const tally *from);

/* Of the triangles of a block, as they were read. */
tally tally_of_block(const pieces *all, const piece_block *block, const void *positions, bool has_sums);

/* Reads all blocks by so many threads, for all but the sums. Returns an exit_code. */
int tally_read(const pieces *all, unsigned threads, bool is_quiet, tally *found);

#endif
