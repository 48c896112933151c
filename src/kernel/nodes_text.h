/*
 * nodes_text.h - the texts of a kernel about indices and their order, and its table. After: a vocabulary of float, and KERNEL,
 * its name.
 */
#if defined(TRIBOX_VEC_H) /* or the compiler is for another processor */
#include "base/bits.h"
#include "index/kernel_nodes.h"
#include "axes.h"
#include "kernel/nodes/extents.h"
#include "kernel/nodes/nodes.h"
#include "frame.h"
#include "kernel/nodes/slabs.h"
#include "kernel/nodes/middles.h"
#include "kernel/nodes/rank.h"
#include "kernel/nodes/cut.h"

extern const tribox_nodes_kernel TRIBOX_SYMBOL(nodes);
const tribox_nodes_kernel TRIBOX_SYMBOL(nodes) = {
    .bound_words = bound_words,
    .bound_nodes = bound_nodes,
    .touch = touch,
    .find_centred = find_centred,
    .find_middles = find_middles,
    .cut = cut,
    .touch_oriented = touch_oriented,
};

#else
typedef int tribox_no_kernel_for_this_processor;
#endif
#if TRIBOX_POP_TARGET
#pragma clang attribute pop
#endif
