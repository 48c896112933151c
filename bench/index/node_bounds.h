/*
 * node_bounds.h - which nodes and words of 64 triangles a question comes by: counted here from the soup itself, as the index hides
 * what it does.
 */
#ifndef BENCH_NODE_BOUNDS_H
#define BENCH_NODE_BOUNDS_H

#include <stdbool.h>

#include "tribox.h"

enum { NODE_LEVELS = 8 };

typedef struct node_bounds {
    tribox_box *level[NODE_LEVELS]; /* of 64 triangles, of 64 of these, and so on to the one of all */
    size_t count[NODE_LEVELS];
    int levels;
    tribox_box *storage;
} node_bounds;

typedef struct node_visits {
    size_t nodes;  /* of 64 children, each tested against the box */
    size_t asked;  /* words that cross its border */
    size_t inside; /* words that lie wholly in it */
} node_visits;

/* Triangles have to be finite. False if memory fails. */
bool node_bounds_make(const tribox_soup *soup, node_bounds *made);

void node_bounds_free(node_bounds *made);

/* asked: room for the numbers of words that are asked, in ascending order; NULL if they are only counted. */
node_visits node_bounds_visit(const node_bounds *b, const tribox_box *box, uint32_t *asked);

#endif
