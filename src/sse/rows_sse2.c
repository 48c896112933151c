/* rows_sse2.c - cells of grids, in double with SSE2. */
#include "vec_sse2_double.h"
#define KERNEL sse2
#include "kernel/rows_text.h"
