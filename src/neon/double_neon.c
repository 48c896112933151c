#include "neon/vec_neon_double.h"
#define KERNEL neon
#include "kernel/axes.h"
#include "kernel/bounds.h"
#include "kernel/doubles.h"
