#include "sse/vec_sse2_double.h"
#define KERNEL sse2
#include "kernel/axes.h"
#include "kernel/touched.h"
#include "kernel/rows.h"
