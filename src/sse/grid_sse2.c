#include "sse/vec_sse2_double.h"
#define KERNEL sse2
#include "kernel/axes.h"
#include "kernel/reach.h"
#include "kernel/rows.h"
