/* cells_neon.c - cells of grids, in float with NEON. */
#include "neon/vec_neon.h"
#define KERNEL neon
#include "kernel/cells.h"
