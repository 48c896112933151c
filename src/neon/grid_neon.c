/* grid_neon.c - cells of grids, in double with NEON. */
#include "neon/vec_neon_double.h"
#define KERNEL neon
#include "kernel/grid.h"
