/* cells_neon.c - cells of grids, in float with NEON. */
#include "vec_neon.h"
#define KERNEL neon
#include "kernel/cells_text.h"
