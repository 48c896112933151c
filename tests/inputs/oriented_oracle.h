/*
 * oriented_oracle.h - the true answer for a triangle and an oriented box, in rational numbers. Shares no line with the library.
 *
 * For finite triangles and finite boxes; a negative half length makes the box empty.
 */
#ifndef TRIBOX_TESTS_ORIENTED_ORACLE_H
#define TRIBOX_TESTS_ORIENTED_ORACLE_H

#include <stdbool.h>
#include <stdio.h>

#include "tribox.h"

/* Whether some point of the triangle lies in the box: moved into the frame, then clipped against its six half-spaces. */
bool oriented_oracle(const double u[3][3], const tribox_oriented_box *box);

/* Whether the bounding box of the moved triangle meets the box. */
bool oriented_oracle_bounds(const double u[3][3], const tribox_oriented_box *box);

/* The same two questions with each half length changed by `change`; nothing overlaps a box that this makes empty. */
bool oriented_oracle_within(const double u[3][3], const tribox_oriented_box *box, const double change[3], bool bounds_alone);

/* Triangle and box in hexadecimal. */
void oriented_explain(FILE *out, const double u[3][3], const tribox_oriented_box *box);

#endif
