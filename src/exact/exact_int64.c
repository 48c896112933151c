/* exact_int64.c - pairs and oriented pairs in 64-bit integers. */
#include "exact/exact.h"
#include "exact/oriented.h"
typedef int64_t vnum;
#include "exact/num_integer.h"
#include "kernel/axes.h"
#include "exact/integers.h"
#define EXACT_IN_INTEGERS tribox_exact_int64
#include "exact/pair.h"
#define ORIENTED_IN_INTEGERS tribox_oriented_int64
#include "exact/oriented_pair.h"
