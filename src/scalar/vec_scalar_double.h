/* vec_scalar_double.h - one lane of double: the definition of the words in double. kernel/README.md has the rest. */
#include "base/targets.h"
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-vectorize")
#endif
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/inexact_flag.h"
#include "kernel.h"

#define V_LANES 1
#define V_FUSED 0 /* v_fma and v_fms round twice */
#define V_UNIT 0x1p-53

typedef double vnum;
typedef bool vmask;

TRIBOX_INLINE vnum v_load(const float *p) { return *p; }
TRIBOX_INLINE vnum v_read(const double *p) { return *p; }
TRIBOX_INLINE void v_write(double *p, vnum a) { *p = a; }
TRIBOX_INLINE void v_write_int(int32_t *p, vnum a) { *p = (int32_t)a; }
TRIBOX_INLINE vnum v_splat(double a) { return a; }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return a + b; }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return a - b; }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return a * b; }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return a / b; }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return a * b + c; }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return a * b - c; }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return a < b ? a : b; }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return a > b ? a : b; }
TRIBOX_INLINE vnum v_abs(vnum a) { return fabs(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return signbit(sign) ? -a : a; }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return a > b; }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return m ? (double)NAN : a; }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return m ? a : b; }

TRIBOX_INLINE vmask m_all(void) { return true; }
TRIBOX_INLINE vmask m_none(void) { return false; }
TRIBOX_INLINE vmask m_not(vmask a) { return !a; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return a | b; }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return a & b; }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return a & !b; }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return a; }
