/* exact_int64.c - pairs and oriented pairs in 64-bit integers. */
#include "exact.h"
#include "oriented.h"
typedef int64_t vnum;
#include "num_integer.h"
#include "kernel/axes.h"
#include "integers.h"
#define EXACT_IN_INTEGERS tribox_exact_int64
#include "pair.h"
#define ORIENTED_IN_INTEGERS tribox_oriented_int64
#include "oriented_pair.h"
