#include "avx2/vec_avx2_double.h"
#define KERNEL avx2
#include "kernel/axes.h"
#include "kernel/touched.h"
#include "kernel/rows.h"
