/* oriented_int64.c - oriented pairs in 64-bit integers. */
#include "oriented.h"
typedef int64_t vnum;
#include "exact/num_integer.h"
#include "kernel/axes.h"
#include "exact/integers.h"
#define ORIENTED_IN_INTEGERS tribox_oriented_int64
#include "oriented_pair.h"
