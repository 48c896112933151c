/* octree.h - the tests that the last level of an octree takes: the triangles of a node against the boxes of its eight leaves. */
#ifndef OCTREE_H
#define OCTREE_H

#include "timing/work.h"

enum { OCTREE_DEPTH_MOST = 10 };

/* The depth at which a leaf of a surface of that many triangles has about 16 of them. */
unsigned octree_depth_for(size_t triangles);

/*
 * Divides the bounding cube of the finite triangles `depth` times, each time keeping what overlaps, and makes the work of the last
 * division: a job for each leaf of a node that has triangles. Of many nodes every k-th is taken, so that there are about
 * `pairs_most` pairs. Returns NULL, or what failed.
 */
const char *octree_work(const tribox_soup *soup, unsigned depth, size_t pairs_most, timing_work *work);

#endif
