/* contact.h - triangles made to touch a box from outside, with a face, an edge axis, a vertex or the plane. */
#ifndef TRIBOX_TESTS_CONTACT_H
#define TRIBOX_TESTS_CONTACT_H

#include "random_draws.h"
#include "tribox.h"

/* The part of the triangle in which the point of contact lies. */
typedef enum contact_part { CONTACT_VERTEX, CONTACT_EDGE, CONTACT_INSIDE, CONTACT_PARTS } contact_part;

/*
 * Two ways to choose the numbers. On a lattice, where `step` is the unit of the box's bounds too, all of them are few steps, so
 * that the contact is exact and single precision is exact as well. With step 0 they are any, of about `size`, and the rounding
 * leaves the triangle within an ulp or so of contact.
 */
typedef struct contact_style {
    double step;
    double size; /* without a step */
} contact_style;

contact_part any_contact_part(random_source *r);

/* Of floats, and of doubles. */
void draw_contact(random_source *r, const tribox_box *box, contact_style style, contact_part part, float u[3][3]);
void draw_contact_f64(random_source *r, const tribox_box *box, contact_style style, contact_part part, double u[3][3]);

/* The latter in two steps: the direction m from box to triangle, then a triangle with no point beyond the plane of contact. */
void draw_outward(random_source *r, contact_style style, double m[3]);
void draw_contact_along(random_source *r, const tribox_box *box, contact_style style, contact_part part, const double m[3],
                        double u[3][3]);

/* The nearest finite float. */
float nearest_float(double number);

/* Moves a number by at most `ulps` floats up or down, never to infinity. */
float nudged(random_source *r, float number, int ulps);

#endif
