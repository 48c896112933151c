/* index_levels.h - where the nodes of an index lie: level after level, the lowest, over words of the soup, first. */
#ifndef TRIBOX_INDEX_LEVELS_H
#define TRIBOX_INDEX_LEVELS_H

#include "base/bits.h"
#include "kernel_nodes.h"

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
