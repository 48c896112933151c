#include "avx512/vec_avx512_double.h"
#define KERNEL avx512
#include "kernel/axes.h"
#include "kernel/bounds.h"
#include "kernel/doubles.h"
