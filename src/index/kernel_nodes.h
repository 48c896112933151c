/* kernel_nodes.h - how src/index and the kernels speak of the nodes of an index, and of the order that makes it fast. */
#ifndef TRIBOX_KERNEL_NODES_H
#define TRIBOX_KERNEL_NODES_H

#include "pairs/rounded_frame.h"

/*
 * A node: the bounds of 64 children, each a word of 64 triangles or a node of the level below. bound[a][c] is the lower bound of
 * child c on axis a, bound[3 + a][c] the upper one, both over its finite triangles alone. A child that has none is nowhere: its
 * lower bounds are infinity, its upper ones -infinity. Zeros are positive, so that every kernel writes the same bytes.
 *
 * Of doubles each bound is seen from the origin of the node, and rounded: comparisons with a box that is seen so, too, are right
 * (PROOFS.md 13.5). Bounds beyond the greatest float are that.
 */
typedef struct tribox_node {
    float bound[6][64];
    uint64_t whole;     /* bit c: every triangle that child c has room for is there and finite */
    double origin[3];   /* of floats zero */
    uint64_t unused[4]; /* zero; so that nodes begin at a line of the cache */
} tribox_node;

/*
 * Writes the children from `child` to before `end` of a node, whole packets: the words of a soup from word `first` on. Those that
 * are not there are nowhere.
 */
typedef void tribox_bound_words(const tribox_soup *soup, size_t first, int child, int end, tribox_node *node);

/* Writes a node over `count` nodes, 0 to 64, that lie one after another at any alignment: each bound as the child has it. */
typedef void tribox_bound_nodes(const void *nodes, size_t count, tribox_node *node);

/*
 * A box as the bounds of a node are compared with it, and in their order: children beyond `outer` are apart from it, and those that
 * are not beyond `inner` lie inside.
 */
typedef struct tribox_node_box {
    float outer[6], inner[6];
} tribox_node_box;

/*
 * The first `count` children of a node, 64 at most, against a box: those that touch it, and those of them that lie wholly inside.
 * Bits past the first `count` mean nothing.
 */
typedef struct tribox_touch {
    uint64_t touching, inside;
} tribox_touch;

typedef tribox_touch tribox_touch_node(const tribox_node *node, unsigned count, const tribox_node_box *box);

/* The same of an oriented box: some of the children may touch, for all that rounding may have done, and those inside are so. */
typedef tribox_touch tribox_touch_oriented(const tribox_node *node, unsigned count, const tribox_rounded_frame *box);

/* The children the middle of whose bounds is in the box: which of their triangles are likely to overlap. */
typedef uint64_t tribox_find_centred(const tribox_node *node, const tribox_node_box *box);

/* Where triangles or boxes lie: the middle of each bounding box, infinite where one is not finite, and its number. */
typedef struct tribox_sort_keys {
    float *middle[3];
    uint32_t *number;
} tribox_sort_keys;

/*
 * The places of `count` triangles of a soup, from triangle `first` on, or where it is NULL of boxes: numbered from `number` on.
 */
typedef void tribox_find_middles(const tribox_soup *soup, const tribox_boxes *boxes, size_t first, size_t count, size_t number,
                                 const tribox_sort_keys *places);

/* Puts the `before` places that come before a cut before the others, of `count`, which are more than 64. */
typedef void tribox_cut(const tribox_sort_keys *places, size_t count, size_t before);

typedef struct tribox_nodes_kernel {
    tribox_bound_words *bound_words;
    tribox_bound_nodes *bound_nodes;
    tribox_touch_node *touch;
    tribox_touch_oriented *touch_oriented;
    tribox_find_centred *find_centred;
    tribox_find_middles *find_middles;
    tribox_cut *cut;
} tribox_nodes_kernel;

#endif
