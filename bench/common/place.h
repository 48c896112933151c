/* place.h - triangles in spatial order. */
#ifndef BENCH_PLACE_H
#define BENCH_PLACE_H

#include <stdbool.h>
#include <stddef.h>

#include "draw.h"

/*
 * Sorts triangles by the place of their centroids, as a spatial tree would leave them: in Morton order of 1024 x 1024 x 1024 cells
 * of the cube [-reach, reach]^3, in which they lie. False if memory fails.
 */
bool place_sort(triangle *triangles, size_t count, float reach);

#endif
