/* pairs_scalar.c - the kernel of one lane: everything in float, and the table of what it does. */
#include "vec_scalar.h"
#define KERNEL scalar
#include "kernel/pairs_text.h"
