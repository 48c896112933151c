#include "sse/vec_sse2_double.h"
#define KERNEL sse2
#include "kernel/axes.h"
#include "kernel/bounds.h"
#include "kernel/doubles.h"
