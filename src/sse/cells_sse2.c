/* cells_sse2.c - cells of grids, in float with SSE2. */
#include "vec_sse2.h"
#define KERNEL sse2
#include "kernel/cells_text.h"
