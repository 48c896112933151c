/* grid.h - the texts about rows of a grid, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#include "fill_crossings.h"
#include "voxels.h"
#include "axes.h"
#include "limits.h"
#include "rows.h"
#include "own_planes.h"
#include "columns.h"
#include "packed_rows.h"
#include "open_rows.h"
#if !defined(TRIBOX_SMALL)
#include "crossings.h"
#endif
#include "strips.h"
