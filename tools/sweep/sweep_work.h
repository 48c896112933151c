/* sweep_work.h - what tribox sweep times: a mesh against one box, cells of a grid, or the leaves of an octree. */
#ifndef SWEEP_WORK_H
#define SWEEP_WORK_H

#include "read/mesh.h"
#include "timing/work.h"

typedef enum sweep_kind { SWEEP_OCTREE, SWEEP_GRID, SWEEP_BOX } sweep_kind;

typedef struct sweep_wish {
    sweep_kind kind;
    tribox_box box; /* of SWEEP_BOX */
    unsigned depth; /* of SWEEP_OCTREE; 0 for one that suits the mesh, and then written */
    unsigned along; /* of SWEEP_GRID: cells along the longest side */
} sweep_wish;

/* Makes the work. Returns an exit_code; on success timing_work_free gives the memory back. path: of the mesh, for messages. */
int sweep_work_make(const char *path, const mesh *m, sweep_wish *wish, timing_work *work);

/* The wish in words, as in "the leaves of an octree of depth 6, ...". */
void sweep_work_describe(const sweep_wish *wish, const timing_work *work, char *text, size_t size);

/* Cells along the longest side of the mesh, at most: more are finer than floats can tell apart. */
enum { CELLS_ALONG_MOST = 4096 };

/*
 * Divides the cube over the finite triangles of a soup, of which there has to be one, into `along` cells on each axis, and makes a
 * job of the whole soup for each of up to `most` different cells: a random point of a random triangle picks the cell that holds it.
 * The leaves of an octree of depth d are the cells of along = 2^d. Returns NULL, or what failed.
 */
const char *cells_work(const tribox_soup *soup, unsigned along, size_t most, uint64_t seed, timing_work *work);

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
