/* pairs_neon.c - the kernel of NEON: everything in float, and the table of what it does. */
#include "vec_neon.h"
#define KERNEL neon
#include "kernel/pairs_text.h"
