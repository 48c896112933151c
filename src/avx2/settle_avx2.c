/* settle_avx2.c - what float leaves undecided, in double with AVX2 and FMA. */
#include "vec_avx2_double.h"
#define KERNEL avx2
#include "kernel/settle_text.h"
