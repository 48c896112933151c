/* rows_text.h - the texts about rows of a grid, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#if defined(TRIBOX_VEC_H) /* or the compiler is for another processor */
#include "fill/fill_crossings.h"
#include "voxels/voxelizing.h"
#include "axes.h"
#include "limits.h"
#include "kernel/rows/rows.h"
#include "kernel/rows/columns.h"
#include "kernel/rows/packed_rows.h"
#include "kernel/rows/crossings.h"
#include "kernel/rows/strips.h"

#else
typedef int tribox_no_kernel_for_this_processor;
#endif
#if TRIBOX_POP_TARGET
#pragma clang attribute pop
#endif
