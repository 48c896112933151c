/*
 * shell.h - the surface between set and clear cells as triangles.
 *
 * Faces are merged into rectangles, and a rectangle is cut into triangles that have every vertex on its sides: edges match, none
 * ends inside another. Each edge is of two triangles, once in each direction, and around a vertex all triangles hang together; set
 * cells that touch in an edge or a corner alone are apart there. Seen from outside triangles go counterclockwise.
 */
#ifndef SHELL_H
#define SHELL_H

#include "lattice.h"

typedef struct shell_side shell_side; /* vertices along a side of a rectangle */

typedef struct shell {
    lattice points;
    uint64_t *mask;
    shell_side *side; /* room for four sides */
    uint64_t triangles;
} shell;

/* What it takes besides the cells, in bytes. */
uint64_t shell_bytes(const tribox_grid *grid);

/*
 * Finds vertices, which points.vertices tells, and counts triangles, unless there are more vertices than the most. cells: one slab
 * with the whole grid, and to stay. tell: as below; told of 0 to 1 of this. Returns false without memory; shell_free is due in any
 * case.
 */
bool shell_make(shell *s, const voxels *cells, bool (*tell)(void *data, double done), void *data);
void shell_free(shell *s);

/* A triangle by the numbers of its vertices, and the colour of the cells behind it, where they have one. */
typedef void shell_taker(void *data, const uint32_t triangle[3], rgb colour);

/* Hands over each triangle. tell: told the share that is done; returns whether to stop. */
void shell_triangles(const shell *s, shell_taker *take, bool (*tell)(void *data, double done), void *data);

#endif
