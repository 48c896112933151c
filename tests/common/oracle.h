/*
 * oracle.h - the true answer for one pair, twice over, in exact integers. Shares no line of arithmetic with the library.
 *
 *   oracle_separating   the classical two-sided test: the triangle and the box projected on each of the axes
 *   oracle_clip         no axis at all: the triangle clipped against the six half-spaces of the box
 *
 * Both are for finite triangles and finite boxes with lo <= hi, whose numbers may be any doubles.
 */
#ifndef TRIBOX_TESTS_ORACLE_H
#define TRIBOX_TESTS_ORACLE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "pair_f64.h"

/* The number of an axis: 0 to 2 the box normals, 3 the triangle's plane, 4 + 3 * i + j the cross product of e_i and edge j. */
enum { ORACLE_AXES = 13, ORACLE_PLANE = 3, ORACLE_EDGES = 4 };

/* Bit k is about axis k; neither is set for an axis of length zero. */
typedef struct oracle_axes {
    unsigned apart;    /* the two projections are disjoint */
    unsigned touching; /* they have one end in common, and nothing else */
} oracle_axes;

oracle_axes oracle_separating(const pair_f64 *pair);

/* The same, always in GMP: oracle_separating takes a shorter way for short numbers. */
oracle_axes oracle_separating_gmp(const pair_f64 *pair);

/* Whether no axis of the chosen groups, a union of TRIBOX_AXES_*, separates. */
bool oracle_overlaps(oracle_axes truth, unsigned groups);

/* The same of any pair: nothing that is not finite overlaps, nor does the empty box. */
bool oracle_pair_overlaps(const pair_f64 *pair, oracle_axes truth, unsigned groups);

/*
 * Whether CONSERVATIVE and FAST may report a pair that does not overlap: each axis of the groups that separates does so by less
 * than 2^-bits (F_a m_b + F_b m_a), of the plane 2^-bits (F_x F_y m_z + F_y F_z m_x + F_z F_x m_y), and no box normal does. Of
 * doubles 47 are promised.
 */
enum { ORACLE_NEAR_BITS = 47 };
bool oracle_is_near(const pair_f64 *pair, oracle_axes truth, unsigned groups, unsigned bits);

/* Whether some point of the triangle lies in the box. */
bool oracle_clip(const pair_f64 *pair);

/*
 * Whether some point of the triangle lies in an oriented box, or with bounds_alone only whether its bounding box in the frame does;
 * and the same with each half length changed by `change`. Finite numbers; a box with a negative half length is empty.
 */
bool oriented_oracle(const double u[3][3], const tribox_oriented_box *box, bool bounds_alone);
bool oriented_oracle_within(const double u[3][3], const tribox_oriented_box *box, const double change[3], bool bounds_alone);
void oriented_explain(FILE *out, const double u[3][3], const tribox_oriented_box *box);

/* The pair in hexadecimal floats, and what each of the thirteen axes says. */
void oracle_explain(FILE *out, const pair_f64 *pair);

/* The fifteen numbers of a pair as integers of one unit: number k is odd[k] * 2^shift[k] units, below 2^bits. */
typedef struct oracle_integers {
    int64_t odd[15];
    unsigned long shift[15];
    int bits;
} oracle_integers;

oracle_integers oracle_integers_of(const pair_f64 *pair);

#if defined(__SIZEOF_INT128__)
/* The longest sum is the plane's: three products of 3 * bits + 3 bits, and the sign. */
enum { ORACLE_INT128_BITS = 40 };

oracle_axes oracle_separating_int128(const oracle_integers *in);
#endif

#endif
