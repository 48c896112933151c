/*
 * local_bounds.h - numbers of doubles as a node has them: seen from its origin, and rounded to float. Rounding keeps the order of
 * numbers, so that what is apart as floats is apart (PROOFS.md 13.5), however far from zero a mesh lies.
 */
#ifndef TRIBOX_LOCAL_BOUNDS_H
#define TRIBOX_LOCAL_BOUNDS_H

#include "kernel_nodes.h"

/* A number that is not NaN, as seen from an origin: the greatest float where it is beyond that. */
float tribox_number_seen(double number, double origin);

/* A box that is finite and not empty. */
void tribox_node_box_seen(const tribox_box *box, const double origin[3], tribox_node_box *seen);

/* The same node with bounds that are wide enough for the numbers that they were rounded from. */
void tribox_node_widen(const tribox_node *node, tribox_node *wide);

/*
 * A node whose bounds are as its children have them, which are nodes of doubles, one after another at any alignment: gives it an
 * origin, and its bounds as they are seen from there.
 */
void tribox_bounds_join(const void *children, size_t count, tribox_node *node);

#endif
