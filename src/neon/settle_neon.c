/* settle_neon.c - what float leaves undecided, in double with NEON. */
#include "vec_neon_double.h"
#define KERNEL neon
#include "kernel/settle_text.h"
