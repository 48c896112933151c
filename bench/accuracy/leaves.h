/* leaves.h - a mesh against cells of a grid over it, or of an octree: as many scenes, which share the soup. */
#ifndef BENCH_CELLS_H
#define BENCH_CELLS_H

#include "common/soups.h"

typedef struct cells {
    scene *at;
    size_t count;
    float (*triangles)[3][3];
} cells;

/** Cells along the longest side of the mesh, at most: more would ask for a finer grid than floats can number. */
enum { CELLS_ALONG_MOST = 4096, CELLS_MOST = 4096 };

/**
 * Divides the cube over the finite triangles of a soup into `along` cells on each axis, and draws up to `most` of those that at
 * least one triangle overlaps: a random triangle, a random point of it, the cell that holds the point.
 * An octree of depth d has the cells of along = 2^d. The soup must outlive the cells.
 * False, with a message on stderr, if memory fails or the soup is too small for such cells.
 */
bool cells_make(const char *name, const char *what, const tribox_soup *soup, unsigned along, size_t most, uint64_t seed,
                cells *made);

void cells_free(cells *made);

#endif
