/* rows_scalar.c - cells of grids, in double with one lane. */
#include "vec_scalar_double.h"
#define KERNEL scalar
#include "kernel/rows_text.h"
