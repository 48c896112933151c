/* rows_avx2.c - cells of grids, in double with AVX2 and FMA. */
#include "vec_avx2_double.h"
#define KERNEL avx2
#include "kernel/rows_text.h"
