/* vec_neon.h - four lanes of NEON, the baseline of AArch64. kernel/README.md defines the words. */
#include "base/targets.h"
#if TRIBOX_NEON
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <arm_neon.h>
#include <stdint.h>
#include <string.h>

#include "base/bits.h"
#include "base/floats.h"
#include "kernel.h"

#define V_LANES 4
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f
#define V_EXTENT 0x1p-54f

typedef float32x4_t vnum;
typedef uint32x4_t vmask;
typedef int32x4_t vint;

TRIBOX_INLINE vmask neon_bits(vnum a) { return vreinterpretq_u32_f32(a); }
TRIBOX_INLINE vnum neon_number(vmask bits) { return vreinterpretq_f32_u32(bits); }

TRIBOX_INLINE vnum v_load(const float *p) { return vld1q_f32(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    const float first = tribox_float_at(p);
    return (vnum){first, tribox_float_at(p + (count > 1)), tribox_float_at(p + 2 * (count > 2)), first};
}
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return count < V_LANES ? v_load_few(p, count) : v_load(p); }
TRIBOX_INLINE vnum v_splat(float a) { return vdupq_n_f32(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { vst1q_f32(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return vaddq_f32(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return vsubq_f32(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return vmulq_f32(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return vdivq_f32(a, b); }
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
TRIBOX_INLINE vnum v_nearest(vnum a) { return vrndnq_f32(a); }
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
/* Of two doubles, at any alignment. */
TRIBOX_INLINE float64x2_t neon_local(const void *p, const double *lo)
{
    return vsubq_f64(vreinterpretq_f64_u8(vld1q_u8(p)), vld1q_f64(lo));
}
TRIBOX_INLINE vnum v_local(const void *p, const double *lo)
{
    return vcvt_high_f32_f64(vcvt_f32_f64(neon_local(p, lo)), neon_local((const char *)p + 16, lo + 2));
}
TRIBOX_INLINE void neon_transpose4(const vnum row[4], vnum to[4])
{
    const float64x2_t even_01 = vreinterpretq_f64_f32(vtrn1q_f32(row[0], row[1]));
    const float64x2_t even_23 = vreinterpretq_f64_f32(vtrn1q_f32(row[2], row[3]));
    const float64x2_t odd_01 = vreinterpretq_f64_f32(vtrn2q_f32(row[0], row[1]));
    const float64x2_t odd_23 = vreinterpretq_f64_f32(vtrn2q_f32(row[2], row[3]));
    to[0] = vreinterpretq_f32_f64(vtrn1q_f64(even_01, even_23));
    to[1] = vreinterpretq_f32_f64(vtrn1q_f64(odd_01, odd_23));
    to[2] = vreinterpretq_f32_f64(vtrn2q_f64(even_01, even_23));
    to[3] = vreinterpretq_f32_f64(vtrn2q_f64(odd_01, odd_23));
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = vreinterpretq_f32_u8(vld1q_u8(from[i]));
    neon_transpose4(row, to);
}
TRIBOX_INLINE void v_local_transpose4(const void *const from[V_LANES], const double lo[4], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = v_local(from[i], lo);
    neon_transpose4(row, to);
}

TRIBOX_INLINE vint i_load(const int32_t *p) { return vld1q_s32(p); }
TRIBOX_INLINE vint i_splat(int32_t a) { return vdupq_n_s32(a); }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { vst1q_s32(p, a); }
TRIBOX_INLINE vint i_cut(vnum a) { return vcvtq_s32_f32(a); }
TRIBOX_INLINE vint i_add(vint a, vint b) { return vaddq_s32(a, b); }
TRIBOX_INLINE vint i_sub(vint a, vint b) { return vsubq_s32(a, b); }
TRIBOX_INLINE vint i_mul(vint a, vint b) { return vmulq_s32(a, b); }
TRIBOX_INLINE vint i_and(vint a, vint b) { return vandq_s32(a, b); }
TRIBOX_INLINE vint i_or(vint a, vint b) { return vorrq_s32(a, b); }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return vbicq_s32(a, b); }
TRIBOX_INLINE vint i_shl(vint a, vint n) { return vshlq_s32(a, n); }
TRIBOX_INLINE vint i_shr(vint a, vint n) { return vreinterpretq_s32_u32(vshlq_u32(vreinterpretq_u32_s32(a), vnegq_s32(n))); }
TRIBOX_INLINE vint i_shl_over(vint a, vint n) { return i_shr(a, vsubq_s32(vdupq_n_s32(32), n)); }
TRIBOX_INLINE vint i_run(vint first, vint end)
{
    const vint ones = vdupq_n_s32(-1);
    return vbicq_s32(vshlq_s32(ones, first), vshlq_s32(ones, end));
}
TRIBOX_INLINE vint i_count(vint a) { return vreinterpretq_s32_u32(vpaddlq_u16(vpaddlq_u8(vcntq_u8(vreinterpretq_u8_s32(a))))); }
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return vandq_s32(vreinterpretq_s32_u32(m), a); }

TRIBOX_INLINE vmask m_has_bits(vint a) { return vtstq_s32(a, a); }
TRIBOX_INLINE vmask m_signs(vnum a) { return vcltzq_s32(vreinterpretq_s32_f32(a)); }
TRIBOX_INLINE vmask m_all(void) { return vdupq_n_u32(UINT32_MAX); }
TRIBOX_INLINE vmask m_none(void) { return vdupq_n_u32(0); }
TRIBOX_INLINE vmask m_not(vmask a) { return vmvnq_u32(a); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return vorrq_u32(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return vandq_u32(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return vbicq_u32(a, b); }
/* NEON has no movemask: each lane keeps its own bit, and the lanes are added up. */
TRIBOX_INLINE uint64_t m_bits(vmask a) { return vaddvq_u32(vandq_u32(a, (vmask){1, 2, 4, 8})); }
TRIBOX_INLINE unsigned m_count(vmask a) { return tribox_count_bits(m_bits(a)); }

/* Each lane goes where those of m before it end: one that is not of m is written over, or lies past the last. */
TRIBOX_INLINE void neon_pack(void *p, vmask m, uint32x4_t a)
{
    const uint64_t bits = m_bits(m), first = bits & 1, second = first + (bits >> 1 & 1), third = second + (bits >> 2 & 1);
    const uint64_t place[V_LANES] = {0, first, second, third};
    for (int i = 0; i < V_LANES; i++) {
        const uint32_t lane = a[i];
        memcpy((uint32_t *)p + place[i], &lane, sizeof lane);
    }
}
TRIBOX_INLINE void v_pack(float *p, vmask m, vnum a) { neon_pack(p, m, neon_bits(a)); }
TRIBOX_INLINE void i_pack(int32_t *p, vmask m, vint a) { neon_pack(p, m, vreinterpretq_u32_s32(a)); }

#endif
