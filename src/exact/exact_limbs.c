#include "exact.h"
#include "exact/num_limbs.h"
#include "kernel/axes.h"
#define EXACT_IN_INTEGERS tribox_exact_limbs
#include "exact/integers.h"
