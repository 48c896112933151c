/* grid_scalar.c - cells of grids, in double with one lane. */
#include "scalar/vec_scalar_double.h"
#define KERNEL scalar
#include "kernel/grid.h"
