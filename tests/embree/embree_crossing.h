/*
 * embree_crossing.h - where a line along an axis crosses the plane of a triangle: in double, from the floats that Embree was
 * given.
 */
#ifndef TRIBOX_TESTS_CROSSING_H
#define TRIBOX_TESTS_CROSSING_H

#include <stdbool.h>

#include "model.h"

typedef struct crossing {
    double t;           /* from the start of the line */
    double place;       /* the coordinate on the axis */
    double barycentric; /* the smallest of the three: below zero outside the triangle */
    double cosine;      /* between the line and the triangle's normal, with its sign */
    double float_error; /* a bound on what Embree's own t may be off */
} crossing;

/* False if the line is parallel to the plane, or the triangle has none. */
bool crossing_make(const triangle *t, int axis, const float from[3], crossing *c);

#endif
