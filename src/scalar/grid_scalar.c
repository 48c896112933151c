#include "scalar/vec_scalar_double.h"
#define KERNEL scalar
#include "kernel/axes.h"
#include "kernel/touched.h"
#include "kernel/rows.h"
