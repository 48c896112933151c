/* contact_f64.h - triangles of doubles made to touch a box from outside, and small changes to them. */
#ifndef TRIBOX_TESTS_CONTACT_F64_H
#define TRIBOX_TESTS_CONTACT_F64_H

#include "scenes_f64.h"

/*
 * A triangle about as large as `size` that touches the box with a vertex, an edge or its inside, but for rounding, and has no point
 * beyond a plane of contact.
 */
void contact_f64(random_source *r, const tribox_box *box, double size, double u[3][3]);

/* A triangle whose edge or plane goes through a corner of the box, or a vertex of which is one. Mostly it enters the box. */
void through_corner_f64(random_source *r, const tribox_box *box, double size, double u[3][3]);

/* The double that is n steps away. */
double stepped_f64(double x, int n);

/* Moves some coordinates by up to `most` doubles, or by up to `most` times `by`. */
void nudge_f64(random_source *r, double u[3][3], int most);
void shift_f64(random_source *r, double u[3][3], int most, double by);

/* A box from -lo to hi, each a length between least and most. */
tribox_box box_f64_about_zero(random_source *r, double least, double most);

/* Everything times 2^exponent[a], and moved by offset[a] of that unit. */
void place_f64(batch_f64 *batch, const int exponent[3], const double offset[3]);

#endif
