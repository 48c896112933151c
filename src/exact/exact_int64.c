#include "exact.h"
typedef int64_t vnum;
#include "exact/num_integer.h"
#include "kernel/axes.h"
#define EXACT_IN_INTEGERS tribox_exact_int64
#include "exact/integers.h"
