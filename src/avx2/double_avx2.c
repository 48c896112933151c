#include "avx2/vec_avx2_double.h"
#define KERNEL avx2
#include "kernel/axes.h"
#include "kernel/bounds.h"
#include "kernel/doubles.h"
