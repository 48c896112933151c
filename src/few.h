/*
 * few.h - fewer pairs than a kernel has lanes: spread over a packet, as kernels read whole packets. The numbers after them repeat
 * the first pair; they are never asked about.
 */
#ifndef TRIBOX_FEW_H
#define TRIBOX_FEW_H

#include "kernel.h"

typedef struct tribox_few {
    _Alignas(64) float number[9][TRIBOX_LANES_MAX];
    tribox_soup soup;
    tribox_boxes boxes;
} tribox_few;

static inline bool tribox_is_few(size_t count, const tribox_kernel *kernel) { return count < kernel->lanes; }

/* One triangle at least, fewer than the kernel has lanes: the same soup, in `few`. */
const tribox_soup *tribox_few_triangles(const tribox_soup *soup, const tribox_kernel *kernel, tribox_few *few);

/* The same for the triangles or boxes of some pairs. */
tribox_pairs tribox_few_pairs(const tribox_pairs *p, const tribox_kernel *kernel, tribox_few *few);

#endif
