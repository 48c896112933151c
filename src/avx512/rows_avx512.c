/* rows_avx512.c - cells of grids, in double with AVX-512F. */
#include "vec_avx512_double.h"
#define KERNEL avx512
#include "kernel/rows_text.h"
