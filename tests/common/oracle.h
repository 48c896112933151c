/*
 * oracle.h - the true answer for one pair, twice over, in exact integers. Shares no line of arithmetic with the library.
 *
 *   oracle_separating   the classical two-sided test: the triangle and the box projected on each of the axes
 *   oracle_clip         no axis at all: the triangle clipped against the six half-spaces of the box
 *
 * Both are for finite triangles and finite boxes with lo <= hi.
 */
#ifndef TRIBOX_TESTS_ORACLE_H
#define TRIBOX_TESTS_ORACLE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "pair_f32.h"

/* The number of an axis: 0 to 2 the box normals, 3 the triangle's plane, 4 + 3 * i + j the cross product of e_i and edge j. */
enum { ORACLE_AXES = 13, ORACLE_PLANE = 3, ORACLE_EDGES = 4 };

/* Bit k is about axis k; neither is set for an axis of length zero. */
typedef struct oracle_axes {
    unsigned apart;    /* the two projections are disjoint */
    unsigned touching; /* they have one end in common, and nothing else */
} oracle_axes;

oracle_axes oracle_separating(const pair_f32 *pair);

/* The same, always in GMP: oracle_separating takes a shorter way for short numbers. */
oracle_axes oracle_separating_gmp(const pair_f32 *pair);

/* Whether no axis of the chosen groups, a union of TRIBOX_AXES_*, separates. */
bool oracle_overlaps(oracle_axes truth, unsigned groups);

/* Whether some point of the triangle lies in the box. */
bool oracle_clip(const pair_f32 *pair);

/* The pair in hexadecimal floats, and what each of the thirteen axes says. */
void oracle_explain(FILE *out, const pair_f32 *pair);

/* The fifteen numbers of a pair as integers of one unit: number k is odd[k] * 2^shift[k] units, below 2^bits. */
typedef struct oracle_integers {
    int64_t odd[15];
    unsigned long shift[15];
    int bits;
} oracle_integers;

oracle_integers oracle_integers_of(const pair_f32 *pair);

/* Of any fifteen finite doubles: nine of the triangle by vertex, three of lo, three of hi. */
oracle_integers oracle_integers_of_numbers(const double number[15]);

/* The answer about them, and the same always in GMP. */
oracle_axes oracle_separating_integers(const oracle_integers *in);
oracle_axes oracle_separating_integers_gmp(const oracle_integers *in);

#if defined(__SIZEOF_INT128__)
/* The longest sum is the plane's: three products of 3 * bits + 3 bits, and the sign. */
enum { ORACLE_INT128_BITS = 40 };

oracle_axes oracle_separating_int128(const oracle_integers *in);
#endif

#endif
