/*
 * cell_oracle.h - the oracle's answer for one finite triangle and very many boxes, quickly: the thirteen projections in double,
 * and the exact oracle wherever they come near each other. Shares no line of arithmetic with the library.
 */
#ifndef TRIBOX_TESTS_CELL_ORACLE_H
#define TRIBOX_TESTS_CELL_ORACLE_H

#include "common/oracle.h"

/* One triangle, its thirteen axes and its interval on each. */
typedef struct cell_oracle {
    double u[3][3];
    double axis[ORACLE_AXES][3];
    double slack[ORACLE_AXES][3]; /* an upper bound on each component of the axis, before anything cancels */
    double least[ORACLE_AXES], most[ORACLE_AXES];
    double weight[ORACLE_AXES]; /* the largest sum of products, taken positive, that made the interval */
} cell_oracle;

cell_oracle cell_oracle_make(const double u[3][3]);

/* Whether no axis of the chosen groups, a union of TRIBOX_AXES_*, separates the triangle and the box (lo <= hi). */
bool cell_oracle_overlaps(const cell_oracle *t, const tribox_box *box, unsigned groups);

/*
 * Whether a wrong answer errs within a band of contact. A box moved by the band changes the slack of an axis by at most
 *   F_a band_b + F_b band_a        on the axes of e_i and an edge, F the extents of the triangle
 *   sum of F_a F_b band_i          on the plane
 * and by that much the slack may be wrong; the box normals are always right. Axes of length zero excuse nothing.
 */
bool cell_oracle_errs_within(const cell_oracle *t, const tribox_box *box, unsigned groups, const double band[3], bool answer);

/* The pair in hexadecimal numbers, and what each axis says. */
void cell_oracle_explain(FILE *out, const cell_oracle *t, const tribox_box *box);

#endif
