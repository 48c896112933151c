/* settle_sse2.c - what float leaves undecided, in double with SSE2. */
#include "vec_sse2_double.h"
#define KERNEL sse2
#include "kernel/settle_text.h"
