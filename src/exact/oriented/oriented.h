/* oriented.h - one triangle and one oriented box, settled in integers. No allocation, no library. */
#ifndef TRIBOX_EXACT_ORIENTED_H
#define TRIBOX_EXACT_ORIENTED_H

#include <stdbool.h>
#include <stdint.h>

#include "tribox.h"

/* One question: does this triangle, u[j][a] axis a of vertex j, overlap this box? */
typedef struct tribox_oriented_pair {
    double u[3][3];
    tribox_oriented_box box;
} tribox_oriented_pair;

/* Whether no axis of the chosen groups separates in the frame of the box: for a finite triangle and a finite box. */
bool tribox_oriented_overlap(const tribox_oriented_pair *pair, unsigned axes);

/* A finite double as odd * 2^shift; zero as 0 * 2^0. */
typedef struct tribox_integer {
    int64_t odd;
    int shift;
} tribox_integer;

/*
 * The numbers of such a pair as integers. Positions have one unit and axes another; a coordinate in the frame, axis times position,
 * times 2^shift is in the unit of the half lengths.
 */
typedef struct tribox_oriented_integers {
    tribox_integer position[12]; /* x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2, then the center */
    tribox_integer axis[9];
    tribox_integer half[3];
    int shift;
    int bits; /* every coordinate in the frame, and every half length, is below 2^bits units */
} tribox_oriented_integers;

/* What each width of integer can carry: 3 * bits + 8 for the plane's slack, with one to spare, and the sign (PROOFS.md 9.4). */
enum { TRIBOX_INT64_BITS = 18, TRIBOX_INT128_BITS = 39 };

bool tribox_oriented_int64(const tribox_oriented_integers *in, unsigned axes);
#if defined(__SIZEOF_INT128__)
bool tribox_oriented_int128(const tribox_oriented_integers *in, unsigned axes);
#endif

/* Any pair, sign by sign: in double, or where rounding could turn one in a sum as long as it takes. */
bool tribox_oriented_long(const tribox_oriented_pair *pair, unsigned axes);

#endif
