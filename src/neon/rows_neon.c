/* rows_neon.c - cells of grids, in double with NEON. */
#include "vec_neon_double.h"
#define KERNEL neon
#include "kernel/rows_text.h"
