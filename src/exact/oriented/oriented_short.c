/* oriented_short.c - oriented pairs in limbs, as many as ordinary scenes need. */
#include "oriented.h"
/* As long as numbers of ordinary scenes need: 3 * TRIBOX_SHORT_BITS + 8 = 443 bits. What is shorter is copied faster. */
#define LIMBS 16
#include "exact/num_limbs.h"
#include "kernel/axes.h"
#include "exact/integers.h"
#define ORIENTED_IN_INTEGERS tribox_oriented_short
#include "oriented_pair.h"
