/* vec_neon.h - four lanes of NEON, the baseline of AArch64. kernel/README.md defines the words. */
#if !defined(__aarch64__) || !defined(__ARM_NEON) || defined(__AARCH64EB__)
#error "compile this file for little-endian AArch64 with NEON"
#endif
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <arm_neon.h>
#include <stdint.h>

#include "kernel.h"

#define V_LANES 4
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f

typedef float32x4_t vnum;
typedef uint32x4_t vmask;

TRIBOX_INLINE vmask neon_bits(vnum a) { return vreinterpretq_u32_f32(a); }
TRIBOX_INLINE vnum neon_number(vmask bits) { return vreinterpretq_f32_u32(bits); }

TRIBOX_INLINE vnum v_load(const float *p) { return vld1q_f32(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    return (vnum){p[0], p[count > 1 ? 1 : 0], p[count > 2 ? 2 : 0], p[0]};
}
TRIBOX_INLINE vnum v_splat(float a) { return vdupq_n_f32(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { vst1q_f32(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return vaddq_f32(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return vsubq_f32(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return vmulq_f32(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return vfmaq_f32(c, a, b); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return vfmaq_f32(vnegq_f32(c), a, b); }
/* FMIN and FMAX have other answers for NaN and for zeros of two signs. */
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return vbslq_f32(vcltq_f32(a, b), a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return vabsq_f32(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign)
{
    return neon_number(veorq_u32(neon_bits(a), vandq_u32(neon_bits(sign), vdupq_n_u32(0x80000000u))));
}
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return neon_number(vorrq_u32(neon_bits(a), neon_bits(b))); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return vcgtq_f32(a, b); }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return vceqzq_f32(a); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return vbslq_f32(m, a, b); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return neon_number(vorrq_u32(neon_bits(a), m)); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES])
{
    float number[2 * V_LANES];
    vst1q_f32(number, a);
    vst1q_f32(number + V_LANES, b);
    return (vnum){number[from[0] % 8], number[from[1] % 8], number[from[2] % 8], number[from[3] % 8]};
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = vreinterpretq_f32_u8(vld1q_u8(from[i]));
    const float64x2_t even_01 = vreinterpretq_f64_f32(vtrn1q_f32(row[0], row[1]));
    const float64x2_t even_23 = vreinterpretq_f64_f32(vtrn1q_f32(row[2], row[3]));
    const float64x2_t odd_01 = vreinterpretq_f64_f32(vtrn2q_f32(row[0], row[1]));
    const float64x2_t odd_23 = vreinterpretq_f64_f32(vtrn2q_f32(row[2], row[3]));
    to[0] = vreinterpretq_f32_f64(vtrn1q_f64(even_01, even_23));
    to[1] = vreinterpretq_f32_f64(vtrn1q_f64(odd_01, odd_23));
    to[2] = vreinterpretq_f32_f64(vtrn2q_f64(even_01, even_23));
    to[3] = vreinterpretq_f32_f64(vtrn2q_f64(odd_01, odd_23));
}

TRIBOX_INLINE vmask m_signs(vnum a) { return vcltzq_s32(vreinterpretq_s32_f32(a)); }
TRIBOX_INLINE vmask m_all(void) { return vdupq_n_u32(UINT32_MAX); }
TRIBOX_INLINE vmask m_none(void) { return vdupq_n_u32(0); }
TRIBOX_INLINE vmask m_not(vmask a) { return vmvnq_u32(a); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return vorrq_u32(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return vandq_u32(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return vbicq_u32(a, b); }
/* NEON has no movemask: each lane keeps its own bit, and the lanes are added up. */
TRIBOX_INLINE uint64_t m_bits(vmask a) { return vaddvq_u32(vandq_u32(a, (vmask){1, 2, 4, 8})); }
