/*
 * parity.h - inside and outside of a closed mesh, cell by cell, from rays that know nothing of triangle and box: cells that no
 * triangle overlaps have a side, neighbours among them have the same side. Cheap, and far weaker than the witnesses: false
 * positives are invisible to it.
 */
#ifndef TRIBOX_TESTS_PARITY_H
#define TRIBOX_TESTS_PARITY_H

#include "embree_planes.h"

size_t parity_cells(const grid_planes *p);

/*
 * One line for every column of cells on each axis, through a drawn point of the column, not near its border. Bit a of sides[cell]
 * (x fastest) is set if the cell lies inside by the line along axis a. `recasts`: how many lines had to be drawn again; may be
 * NULL. False if the mesh is not closed: no line gives both an even count of hits and as many ways in as out. Needs Embree, and a
 * grid that holds the mesh.
 */
bool parity_cast(const grid_planes *p, const model *s, random_source *r, uint8_t *sides, size_t *recasts);

typedef struct parity_verdict {
    size_t disagreements; /* free cells of which the three lines say different things */
    size_t components;    /* of the free cells, neighbours by face, edge or corner */
    size_t mixed;         /* components with both sides in them: a leak */
    size_t border_inside; /* components that reach the grid's border but are inside */
} parity_verdict;

/* `occupied` as tribox_voxelize sets it. */
parity_verdict parity_judge(const grid_planes *p, const uint8_t *sides, const uint64_t *occupied);

#endif
