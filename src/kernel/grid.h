/* grid.h - the texts about cells of a grid, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#include "axes.h"
#include "touched.h"
#include "rows.h"
