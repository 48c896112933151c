/* pairs_sse2.c - the kernel of SSE2: everything in float, and the table of what it does. */
#include "vec_sse2.h"
#define KERNEL sse2
#include "kernel/pairs_text.h"
