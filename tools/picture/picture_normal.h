/* picture_normal.h - the normal of the surface that small cells make. */
#ifndef PICTURE_NORMAL_H
#define PICTURE_NORMAL_H

#include "picture_view.h"

/*
 * The normal of a plane near what a view shows around a point that shows a face. cell: points that a cell takes. Looks at depths in
 * the view alone, so that what is hidden changes nothing.
 */
vec picture_normal(const picture_view *v, const uint32_t *seen, int x, int y, vec face);

#endif
