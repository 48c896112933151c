/*
 * shell.h - the surface between set and clear cells as triangles.
 *
 * Faces are merged into rectangles, and a rectangle is cut into triangles that have every vertex on its sides: edges match, none
 * ends inside another. Each edge is of two triangles, once in each direction, and around a vertex all triangles hang together; set
 * cells that touch in an edge or a corner alone are apart there. Seen from outside triangles go counterclockwise.
 */
#ifndef SHELL_H
#define SHELL_H

#include "colours/rgb.h"
#include "write/voxels.h"

/*
 * Which of the faces around a point of the grid belong together.
 *
 * Eight cells meet in a point; bit dx + 2 dy + 4 dz of their `around` is set where the cell on that side of it is. A face between a
 * set cell and a clear one ends in the point. Two faces with an edge in common belong together; where an edge has four, since two
 * set cells touch in it alone, those of the same cell do. What belongs together is a fan: with a vertex for each fan, the surface
 * is a manifold.
 */
typedef struct fans {
    uint8_t count[256];
    uint8_t of[256][12];
} fans;

typedef struct lattice_extra {
    uint64_t key;   /* 4 times the number of the point; plus 3, or the axis of the edge that begins there */
    uint32_t first; /* the number of its first vertex */
} lattice_extra;

/*
 * The points of the grid, where planes of three axes meet, and the vertices of the surface that lie in them.
 *
 * A point is marked where a rectangle has a corner. Vertices are numbered by their points, x fastest; a point in which fans of
 * faces touch has a vertex for each fan, those after the first numbered behind all points. So are vertices in the middle of an
 * edge: two set cells that touch in an edge and hold together around both of its ends would otherwise have that edge twice.
 */
typedef struct lattice {
    const voxels *cells;
    fans fans;
    uint32_t size[3];             /* points along each axis */
    size_t row_words, cell_words; /* of a row of points, and of cells */
    uint64_t *marks;
    uint32_t *before; /* for each word of marks: the marked points before it */
    lattice_extra *extra;
    size_t extras, room;
    uint64_t points, vertices; /* marked points, and all vertices */
} lattice;

enum { LATTICE_VERTICES_MAX = INT32_MAX }; /* what readers take as an index */

/* Hands over all vertices in the order of their numbers, in halves of cells. Returns false as soon as `take` does. */
bool lattice_vertices(const lattice *l, bool (*take)(void *data, const uint32_t halves[3]), void *data);

typedef struct shell_side shell_side; /* vertices along a side of a rectangle */

typedef struct shell {
    lattice points;
    uint64_t *mask;
    shell_side *side; /* room for four sides */
    uint64_t triangles;
} shell;

/* What it takes besides the cells, in bytes. */
uint64_t shell_bytes(const tribox_grid *grid);

/* Which share of a bar, NULL for none, a walk is. */
typedef struct shell_share {
    progress *bar;
    double from, to;
} shell_share;

/*
 * Finds vertices, which points.vertices tells, and counts triangles, unless there are more vertices than the most. cells: they
 * are to stay. Returns false without memory; shell_free is due in any case.
 */
bool shell_make(shell *s, const voxels *cells, progress *bar, double share);
void shell_free(shell *s);

/* A triangle by the numbers of its vertices, and the colour of the cells behind it, where they have one. False ends the walk. */
typedef bool shell_taker(void *data, const uint32_t triangle[3], rgb colour);

/* Hands over each triangle. */
void shell_triangles(const shell *s, shell_taker *take, void *data, shell_share share);

#endif
