/* cells.h - a mesh against cells of a grid over it. */
#ifndef SWEEP_CELLS_H
#define SWEEP_CELLS_H

#include "timing/work.h"

/* Cells along the longest side of the mesh, at most: more are finer than floats can tell apart. */
enum { CELLS_ALONG_MOST = 4096 };

/*
 * Divides the cube over the finite triangles of a soup, of which there has to be one, into `along` cells on each axis, and makes a
 * job of the whole soup for each of up to `most` different cells: a random point of a random triangle picks the cell that holds it.
 * The leaves of an octree of depth d are the cells of along = 2^d. Returns NULL, or what failed.
 */
const char *cells_work(const tribox_soup *soup, unsigned along, size_t most, uint64_t seed, timing_work *work);

#endif
