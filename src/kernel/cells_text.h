/*
 * cells_text.h - the texts about cells of a grid in float, in order. After: a vocabulary of float, and KERNEL, the kernel's name.
 */
#if defined(TRIBOX_VEC_H) /* or the compiler is for another processor */
#include "voxels/voxelizing.h"
#include "axes.h"
#include "kernel/cells/lattices.h"
#include "kernel/cells/reach.h"
#include "kernel/cells/tile_ranges.h"
#include "kernel/cells/ends.h"
#include "kernel/cells/writes.h"
#include "limits.h"
#include "kernel/cells/runs.h"
#include "kernel/cells/solids.h"
#include "kernel/cells/flats.h"
#include "kernel/cells/bricks.h"
#include "kernel/cells/brick_ids.h"
#include "kernel/cells/cell_numbers.h"
#include "kernel/cells/sorted.h"

#else
typedef int tribox_no_kernel_for_this_processor;
#endif
#if TRIBOX_POP_TARGET
#pragma clang attribute pop
#endif
