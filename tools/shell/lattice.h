/*
 * lattice.h - the points of the grid, where planes of three axes meet, and the vertices of the surface that lie in them.
 *
 * A point is marked where a rectangle has a corner. Vertices are numbered by their points, x fastest; a point in which fans of
 * faces touch has a vertex for each fan, those after the first numbered behind all points. So are vertices in the middle of an
 * edge: two set cells that touch in an edge and hold together around both of its ends would otherwise have that edge twice.
 */
#ifndef LATTICE_H
#define LATTICE_H

#include "rectangles.h"

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

typedef struct lattice {
    const voxels *cells; /* one slab with the whole grid */
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

/* What the lattice of a grid takes, in bytes, besides the extra vertices. */
uint64_t lattice_bytes(const tribox_grid *grid);

/* Returns false without memory; lattice_free is due in any case. */
bool lattice_open(lattice *l, const voxels *cells);
void lattice_free(lattice *l);

void lattice_mark(lattice *l, const rectangle *r);

/* Numbers the vertices, once all is marked. Returns false without memory. More vertices than the most are counted, not numbered. */
bool lattice_number(lattice *l);

/* The next marked point after `at` along an axis, as its coordinate; there is one. */
uint32_t lattice_next(const lattice *l, const uint32_t at[3], int axis);

/* The vertex at a marked point, of the face across `axis` of the set cell at `side` of the point. */
uint32_t lattice_vertex(const lattice *l, const uint32_t at[3], int axis, unsigned side);

/*
 * The vertex in the middle of the edge from a marked point to the next at `to` along an axis, for the set cell at `side` of the
 * point: of those four whose bit of the axis is 1. UINT32_MAX for none.
 */
uint32_t lattice_middle(const lattice *l, const uint32_t at[3], int axis, uint32_t to, unsigned side);

/* Hands over all vertices in the order of their numbers, in halves of cells. Returns false as soon as `take` does. */
bool lattice_vertices(const lattice *l, bool (*take)(void *data, const uint32_t halves[3]), void *data);

#endif
