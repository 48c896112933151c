/* exact_limbs.c - pairs in integers of any length that floats can need. */
#include "exact.h"
/* The longest value, the plane's slack of numbers from 2^-149 to 2^128, takes 3 * 277 + 8 = 839 bits (PROOFS.md 9). */
#define LIMBS 28
#include "num_limbs.h"
#include "kernel/axes.h"
#include "integers.h"
#define EXACT_IN_INTEGERS tribox_exact_limbs
#include "pair.h"
