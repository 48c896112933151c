/* pairs_avx512.c - the kernel of AVX-512F: everything in float, and the table of what it does. */
#include "vec_avx512.h"
#define KERNEL avx512
#include "kernel/pairs_text.h"
