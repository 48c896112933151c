/*
 * num_double.h - one lane of double. Float input leaves it room: every term is a multiple of 2^-447 and below 2^400, so nothing
 * overflows or underflows, and the bounds need neither eta nor tau.
 */
#include <stdbool.h>
#include <stdint.h>
#include <math.h>

#include "kernel.h"

#define V_UNIT 0x1p-53
#define V_ETA 0.0
#define V_TAU 0.0

typedef double vnum;
typedef bool vmask;

TRIBOX_INLINE vnum v_splat(double a) { return a; }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return a + b; }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return a - b; }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return a * b; }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return a * b + c; }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return a * b - c; }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return a < b ? a : b; }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return a > b ? a : b; }
TRIBOX_INLINE vnum v_both(vnum a, vnum b) { return v_max(a, b); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return v_min(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return fabs(a); }
TRIBOX_INLINE vnum v_sign(vnum a) { return a; }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return signbit(sign) ? -a : a; }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return a > b; }
