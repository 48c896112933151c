/* vec_neon_double.h - two lanes of double. */
#include "base/targets.h"
#if TRIBOX_NEON
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <arm_neon.h>
#include <stdint.h>

#include "base/inexact_flag.h"
#include "kernel.h"

#define V_LANES 2
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-53

typedef float64x2_t vnum;
typedef uint64x2_t vmask;

TRIBOX_INLINE vmask neon_bits(vnum a) { return vreinterpretq_u64_f64(a); }
TRIBOX_INLINE vnum neon_number(vmask bits) { return vreinterpretq_f64_u64(bits); }

TRIBOX_INLINE vnum v_load(const float *p) { return vcvt_f64_f32(vld1_f32(p)); }
TRIBOX_INLINE vnum v_read(const double *p) { return vld1q_f64(p); }
TRIBOX_INLINE void v_write(double *p, vnum a) { vst1q_f64(p, a); }
TRIBOX_INLINE void v_write_int(int32_t *p, vnum a) { vst1_s32(p, vmovn_s64(vcvtq_s64_f64(a))); }
TRIBOX_INLINE vnum v_splat(double a) { return vdupq_n_f64(a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return vaddq_f64(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return vsubq_f64(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return vmulq_f64(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return vdivq_f64(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return vfmaq_f64(c, a, b); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return vfmaq_f64(vnegq_f64(c), a, b); }
/* FMIN and FMAX have other answers for NaN and for zeros of two signs. */
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return vbslq_f64(vcltq_f64(a, b), a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return vbslq_f64(vcgtq_f64(a, b), a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return vabsq_f64(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign)
{
    return neon_number(veorq_u64(neon_bits(a), vandq_u64(neon_bits(sign), vdupq_n_u64(UINT64_C(1) << 63))));
}
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return vcgtq_f64(a, b); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return neon_number(vorrq_u64(neon_bits(a), m)); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return vbslq_f64(m, a, b); }

TRIBOX_INLINE vmask m_all(void) { return vdupq_n_u64(UINT64_MAX); }
TRIBOX_INLINE vmask m_none(void) { return vdupq_n_u64(0); }
TRIBOX_INLINE vmask m_not(vmask a) { return veorq_u64(a, m_all()); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return vorrq_u64(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return vandq_u64(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return vbicq_u64(a, b); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return vaddvq_u64(vandq_u64(a, (vmask){1, 2})); }

#endif
