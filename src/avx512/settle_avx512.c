/* settle_avx512.c - what float leaves undecided, in double with AVX-512F. */
#include "vec_avx512_double.h"
#define KERNEL avx512
#include "kernel/settle_text.h"
