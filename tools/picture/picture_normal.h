/* picture_normal.h - the normal of the surface that small cells make. */
#ifndef PICTURE_NORMAL_H
#define PICTURE_NORMAL_H

#include "picture_ray.h"

/*
 * The normal of the plane that fits the occupied cells around one best, on the side that a ray in this direction sees. face: the
 * normal of the face that it hits.
 */
vec picture_normal(const picture_grid *g, const int cell[3], vec face, vec direction);

#endif
