/* cells_avx2.c - cells of grids, in float with AVX2. */
#include "vec_avx2.h"
#define KERNEL avx2
#include "kernel/cells_text.h"
