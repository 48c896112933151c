/*
 * peer.h - other libraries that answer the question of an index: which triangles of a soup overlap each of many boxes? Each has a
 * file of its own, which alone knows it.
 */
#ifndef TRIBOX_TESTS_PEER_H
#define TRIBOX_TESTS_PEER_H

#include <stdbool.h>
#include <stdlib.h>

#include "tribox.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The lists of many boxes, one after another: that of box b begins at start[b]. In a list triangles stand in any order. */
typedef struct peer_lists {
    uint32_t *list;
    size_t *start; /* a number for each box, and one more */
    size_t count, room;
    size_t candidates; /* pairs that were left to a test of the triangle */
} peer_lists;

/* The lists that follow are of this box. */
static inline void peer_lists_begin(peer_lists *to, size_t box) { to->start[box] = to->count; }

/* Memory grows with the first answers alone: later ones of the same boxes find it. */
static inline void peer_lists_add(peer_lists *to, uint32_t triangle)
{
    if (to->count == to->room) {
        to->room = to->room ? 2 * to->room : 4096;
        to->list = (uint32_t *)realloc(to->list, to->room * sizeof *to->list);
        if (!to->list)
            abort();
    }
    to->list[to->count++] = triangle;
}

typedef struct peer {
    const char *name;
    bool is_exact; /* it has to answer as the index does */
    /* A tree over triangles, which are there as long as it: triangles[i][v][a] is axis a of vertex v. NULL if they are too many. */
    void *(*make)(const float (*triangles)[3][3], size_t count);
    void (*release)(void *tree);
    /* What can be done about boxes before the clock runs; NULL for nothing. */
    void (*take_boxes)(void *tree, const tribox_box *boxes, size_t count);
    void (*list)(void *tree, const tribox_box *boxes, size_t count, peer_lists *to);
    /* How many boxes are overlapped at all; NULL if there is no such call. */
    size_t (*any)(void *tree, const tribox_box *boxes, size_t count);
} peer;

extern const peer peer_cgal, peer_embree, peer_embree_boxes, peer_bullet;

#ifdef __cplusplus
}
#endif

#endif
