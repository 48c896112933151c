/* pairs_avx2.c - the kernel of AVX2 and FMA: everything in float, and the table of what it does. */
#include "vec_avx2.h"
#define KERNEL avx2
#include "kernel/pairs_text.h"
