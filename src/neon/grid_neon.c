#include "neon/vec_neon_double.h"
#define KERNEL neon
#include "kernel/axes.h"
#include "kernel/touched.h"
#include "kernel/rows.h"
