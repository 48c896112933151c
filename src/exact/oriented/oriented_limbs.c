/* oriented_limbs.c - oriented pairs in limbs, as many as numbers of unlike sizes need. */
#include "oriented.h"
/* The plane's slack in a frame takes 3 * TRIBOX_LIMBS_BITS + 8 = 959 bits (PROOFS.md 9.4). */
#define LIMBS 32
#include "exact/num_limbs.h"
#include "kernel/axes.h"
#include "exact/integers.h"
#define ORIENTED_IN_INTEGERS tribox_oriented_limbs
#include "oriented_pair.h"
