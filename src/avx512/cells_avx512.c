/* cells_avx512.c - cells of grids, in float with AVX-512F. */
#include "vec_avx512.h"
#define KERNEL avx512
#include "kernel/cells_text.h"
