/* cells_scalar.c - cells of grids, in float with one lane. */
#include "vec_scalar.h"
#define KERNEL scalar
#include "kernel/cells_text.h"
