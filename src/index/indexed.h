/*
 * indexed.h - the triangles that an index is over, of a soup or a mesh: what every call checks of them, and their bounds; and where
 * the nodes lie: level after level, the lowest, over words of triangles, first.
 */
#ifndef TRIBOX_INDEXED_H
#define TRIBOX_INDEXED_H

#include "base/bits.h"
#include "kernel.h"

typedef struct tribox_indexed {
    const tribox_soup *soup; /* or NULL, and */
    tribox_mesh mesh;        /* its strides set */
    bool are_doubles;
    size_t count;
} tribox_indexed;

/* What an index is over, but for vertex numbers that are too great; false if it cannot be read. */
bool tribox_indexed_take(const tribox_index *index, tribox_indexed *over);

/*
 * The node of the lowest level over triangles `first` and after, none of whose vertices is missing. In the environment of
 * environment.h, as what follows.
 */
void tribox_indexed_bound(const tribox_indexed *over, const tribox_kernel *kernel, size_t first, tribox_node *node);

/* A node over nodes (tribox_bound_nodes). */
void tribox_indexed_bound_nodes(const tribox_indexed *over, const tribox_kernel *kernel, const void *nodes, size_t count,
                                tribox_node *node);

/* 64 to the power of this, times 64, is more than any count. */
enum { TRIBOX_INDEX_LEVELS = 10 };

typedef struct tribox_levels {
    unsigned count;                    /* the last one has one node */
    size_t nodes[TRIBOX_INDEX_LEVELS]; /* of a level */
    size_t start[TRIBOX_INDEX_LEVELS]; /* the number of its first node among all nodes */
} tribox_levels;

/*
 * One level at least, and one node. There are as many nodes as words with a bit for each of their children. Written in place, as to
 * return a struct that has just been written would wait for the stores.
 */
static inline void tribox_levels_set(tribox_levels *levels, size_t triangles)
{
    size_t children = tribox_words_of(triangles), start = 0;
    levels->count = 0;
    do {
        const size_t nodes = children ? tribox_words_of(children) : 1;
        levels->nodes[levels->count] = nodes;
        levels->start[levels->count++] = start;
        start += nodes;
        children = nodes;
    } while (children > 1);
}

#endif
