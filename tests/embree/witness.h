/*
 * witness.h - which cells a triangle meets, found by rays and by no separating axis; the only place that knows Embree.
 *
 * Triangle and cell are convex and compact. If they meet, so do they in a point of one of three kinds:
 *   vertex    a vertex of the triangle, in the closed cell
 *   edge      an edge of the triangle crosses the plane of a cell's face, within the closed cell
 *   lattice   an edge line of the cell crosses the inside of the triangle, within the closed cell
 * (The smallest faces of the two bodies that hold an extreme point of their intersection have no direction in common, so their
 * dimensions add up to three at most.) Nothing that is parallel or coplanar needs care. Hence a pair overlaps if and only if it has
 * a witness. Rays along the lattice are cast at the triangles, and the triangles' edges at one huge triangle per plane of the grid.
 */
#ifndef TRIBOX_TESTS_WITNESS_H
#define TRIBOX_TESTS_WITNESS_H

#include "model.h"

/* False, with a line that says why, where the cross-check has to be skipped. */
bool witness_is_usable(void);

/* One bit for each candidate of each triangle: words first_word[t] .. first_word[t + 1] - 1 are those of triangle t. */
typedef struct witness {
    const planes *planes;
    const model *model;
    block *candidates;
    size_t *first_word;
    uint64_t *met;
    size_t hits, edges; /* of lattice lines, and of edges of triangles */
    size_t strays;      /* hits beside the triangle or beyond the edge, cells outside the candidates: a fault of this test, 0 */
} witness;

/* Keeps both arguments. */
witness witness_make(const planes *p, const model *m);
void witness_free(witness *w);

#endif
