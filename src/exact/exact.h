/* exact.h - one triangle and one box, settled in integers. No allocation, no library. Knows nothing of batches or grids. */
#ifndef TRIBOX_EXACT_H
#define TRIBOX_EXACT_H

#include <stdbool.h>

#include "tribox.h"

/* One question: does this triangle, u[j][a] axis a of vertex j, overlap this box? */
typedef struct tribox_pair {
    float u[3][3];
    tribox_box box;
} tribox_pair;

/*
 * Whether no axis of the chosen groups separates, in integers: for a finite triangle and a box with finite lo <= hi, and where the
 * axes have BOX, a pair that the box normals do not separate.
 */
bool tribox_exact_overlap(const tribox_pair *pair, unsigned axes);

/* A finite float as odd * 2^shift; zero as 0 * 2^0. */
typedef struct tribox_integer {
    int32_t odd;
    int shift;
} tribox_integer;

tribox_integer tribox_integer_of(float number);

/*
 * The least and the greatest power of two among numbers: all are multiples of 2^least and below 2^greatest. least > greatest: all
 * zero.
 */
typedef struct tribox_span {
    int least, greatest;
} tribox_span;

tribox_span tribox_span_of(const tribox_integer *numbers, int count);

/* The fifteen numbers of a pair in one unit: x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2, then lo, then hi. */
typedef struct tribox_integers {
    tribox_integer number[15];
    int bits; /* every number is below 2^bits units */
} tribox_integers;

tribox_integers tribox_integers_of(const tribox_pair *pair);

/* What each width of integer can carry: 3 * bits + 8 for the plane's slack, with one to spare, and the sign (PROOFS.md 9). */
enum { TRIBOX_INT64_BITS = 18, TRIBOX_INT128_BITS = 39, TRIBOX_LIMBS_BITS = 277 };

bool tribox_exact_int64(const tribox_integers *in, unsigned axes);
#if defined(__SIZEOF_INT128__)
bool tribox_exact_int128(const tribox_integers *in, unsigned axes);
#endif
bool tribox_exact_limbs(const tribox_integers *in, unsigned axes);

#endif
