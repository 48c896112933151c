/* taken.c - what the float kernels take for underflow, by their own texts: the counting vocabularies have other constants. */
#undef V_FUSED /* of the counts */
#include "scalar/vec_scalar.h"

#include "kernel/axes.h"
#include "kernel/pairs/margin.h"
#include "taken.h"

double taken_eta(void) { return V_ETA * 0x1p150; }

/* h is at least a third of what the m_i have in common (PROOFS.md 4.3). */
double taken_tau(void) { return ((double)tau_of(v_splat(0x1p30f)) - (double)tau_of(v_splat(0))) * 0x1p120 / 3; }
