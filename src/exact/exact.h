/* exact.h - one triangle and one box, settled in integers. No allocation, no library. Knows nothing of batches or grids. */
#ifndef TRIBOX_EXACT_H
#define TRIBOX_EXACT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/compiler.h"

/*
 * One question: does this triangle, u[j][a] axis a of vertex j, overlap this box? Floats are asked about as the doubles that they
 * are.
 */
typedef struct tribox_pair {
    double u[3][3];
    double lo[3], hi[3];
} tribox_pair;

/*
 * Whether no axis of the chosen groups separates, for any finite numbers with lo <= hi; and where the axes have BOX, for a pair
 * that the box normals do not separate.
 */
bool tribox_exact_overlap(const tribox_pair *pair, unsigned axes);

/* The numbers of a pair as integers, in a unit of its own on each axis: at[a] are axis a of the three vertices, of lo and of hi. */
enum { TRIBOX_LO = 3, TRIBOX_HI = 4, TRIBOX_POINTS = 5 };
typedef struct tribox_short_pair {
    int64_t at[3][TRIBOX_POINTS]; /* below 2^60 in size */
} tribox_short_pair;

/* False where the numbers of an axis are not that short in any unit, or all below 2^-963. */
bool tribox_short_pair_of(const tribox_pair *pair, tribox_short_pair *to);

/* The answer to a pair in integers, and the answer to any pair. */
bool tribox_exact_short(const tribox_short_pair *pair, unsigned axes);
bool tribox_exact_long(const tribox_pair *pair, unsigned axes);

#endif
