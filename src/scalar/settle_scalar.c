/* settle_scalar.c - what float leaves undecided, in double with one lane. */
#include "vec_scalar_double.h"
#define KERNEL scalar
#include "kernel/settle_text.h"
