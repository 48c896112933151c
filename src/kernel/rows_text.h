/* rows_text.h - the texts about rows of a grid, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#include "fill/fill_crossings.h"
#include "voxels/voxelizing.h"
#include "axes.h"
#include "limits.h"
#include "kernel/rows/rows.h"
#include "kernel/rows/columns.h"
#include "kernel/rows/packed_rows.h"
#if !defined(TRIBOX_SMALL)
#include "kernel/rows/crossings.h"
#endif
#include "kernel/rows/strips.h"
