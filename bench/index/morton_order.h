/* morton_order.h - the usual order of triangles in space, against that of the library. */
#ifndef BENCH_MORTON_ORDER_H
#define BENCH_MORTON_ORDER_H

#include <stdbool.h>

#include "tribox.h"

/*
 * The middles of the bounding boxes along a Morton curve of 2^16 cells on each axis, sorted by radix. False if memory fails.
 * bounds: of the soup, whose triangles are finite. order: room for soup->count numbers.
 */
bool morton_order(const tribox_soup *soup, const tribox_box *bounds, uint32_t *order);

#endif
