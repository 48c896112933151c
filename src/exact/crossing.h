/*
 * crossing.h - where a point lies to an edge and to a plane, by exact signs. The point is moved by less than any distance, x by
 * e^3, y by e and z by e^2: so it never lies on either (PROOFS.md 15.1).
 */
#ifndef TRIBOX_EXACT_CROSSING_H
#define TRIBOX_EXACT_CROSSING_H

/*
 * Seen along x: 1 left of the edge from a to b, where z is left of y, and -1 right of it; 0 only where a and b are one point.
 * Index: 0 is y, 1 is z.
 */
int tribox_exact_side(const double a[2], const double b[2], const double point[2]);

/* The sign of n . (point - u_0), for a triangle u[j][a] that is not seen as a segment along x. */
int tribox_exact_height(double u[3][3], const double point[3]);

#endif
