/* vec_sse2.h - four lanes of SSE2, the baseline of x86-64. kernel/README.md defines the words. */
#if !defined(__SSE2__)
#error "compile this file with SSE2"
#endif
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <emmintrin.h>
#include <stdint.h>

#include "kernel.h"

#define V_LANES 4
#define V_FUSED 0 /* v_fma and v_fms round twice */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f

typedef __m128 vnum;
typedef __m128 vmask;

TRIBOX_INLINE vnum v_load(const float *p) { return _mm_loadu_ps(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    return _mm_setr_ps(p[0], p[count > 1 ? 1 : 0], p[count > 2 ? 2 : 0], p[0]);
}
TRIBOX_INLINE vnum v_splat(float a) { return _mm_set1_ps(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { _mm_storeu_ps(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return _mm_add_ps(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return _mm_sub_ps(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return _mm_mul_ps(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return _mm_add_ps(_mm_mul_ps(a, b), c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return _mm_sub_ps(_mm_mul_ps(a, b), c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return _mm_min_ps(a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return _mm_max_ps(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return _mm_and_ps(_mm_castsi128_ps(_mm_set1_epi32(0x7fffffff)), a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return _mm_xor_ps(a, _mm_and_ps(_mm_set1_ps(-0.0f), sign)); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return _mm_or_ps(a, b); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return _mm_cmpgt_ps(a, b); }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return _mm_cmpeq_ps(a, _mm_setzero_ps()); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return _mm_or_ps(a, m); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES])
{
    float number[2 * V_LANES];
    _mm_storeu_ps(number, a);
    _mm_storeu_ps(number + V_LANES, b);
    return _mm_setr_ps(number[from[0] % 8], number[from[1] % 8], number[from[2] % 8], number[from[3] % 8]);
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = _mm_loadu_ps((const float *)from[i]);
    const vnum low_01 = _mm_unpacklo_ps(row[0], row[1]), low_23 = _mm_unpacklo_ps(row[2], row[3]);
    const vnum high_01 = _mm_unpackhi_ps(row[0], row[1]), high_23 = _mm_unpackhi_ps(row[2], row[3]);
    to[0] = _mm_movelh_ps(low_01, low_23);
    to[1] = _mm_movehl_ps(low_23, low_01);
    to[2] = _mm_movelh_ps(high_01, high_23);
    to[3] = _mm_movehl_ps(high_23, high_01);
}

TRIBOX_INLINE vmask m_signs(vnum a) { return a; }
TRIBOX_INLINE vmask m_all(void) { return _mm_castsi128_ps(_mm_set1_epi32(-1)); }
TRIBOX_INLINE vmask m_none(void) { return _mm_setzero_ps(); }
TRIBOX_INLINE vmask m_not(vmask a) { return _mm_andnot_ps(a, m_all()); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return _mm_or_ps(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return _mm_and_ps(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return _mm_andnot_ps(b, a); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return (uint64_t)(unsigned)_mm_movemask_ps(a); }
