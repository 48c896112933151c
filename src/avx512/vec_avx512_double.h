/* vec_avx512_double.h - eight lanes of double. */
#include "target_avx512.h"
#if TRIBOX_AVX512
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <immintrin.h>
#include <stdint.h>

#include "base/inexact_flag.h"
#include "kernel.h"

#define V_LANES 8
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-53

typedef __m512d vnum;
typedef __mmask8 vmask;

TRIBOX_INLINE __m512i avx512_bits(vnum a) { return _mm512_castpd_si512(a); }
TRIBOX_INLINE vnum avx512_double(__m512i a) { return _mm512_castsi512_pd(a); }
TRIBOX_INLINE __m512i avx512_minus_zero(void) { return _mm512_set1_epi64(INT64_MIN); }

TRIBOX_INLINE vnum v_load(const float *p) { return _mm512_cvtps_pd(_mm256_loadu_ps(p)); }
TRIBOX_INLINE vnum v_read(const double *p) { return _mm512_loadu_pd(p); }
TRIBOX_INLINE void v_write(double *p, vnum a) { _mm512_storeu_pd(p, a); }
TRIBOX_INLINE void v_write_int(int32_t *p, vnum a) { _mm256_storeu_si256((__m256i *)p, _mm512_cvttpd_epi32(a)); }
TRIBOX_INLINE vnum v_splat(double a) { return _mm512_set1_pd(a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return _mm512_add_pd(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return _mm512_sub_pd(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return _mm512_mul_pd(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return _mm512_div_pd(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return _mm512_fmadd_pd(a, b, c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return _mm512_fmsub_pd(a, b, c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return _mm512_min_pd(a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return _mm512_max_pd(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return avx512_double(_mm512_andnot_si512(avx512_minus_zero(), avx512_bits(a))); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign)
{
    return avx512_double(_mm512_xor_si512(avx512_bits(a), _mm512_and_si512(avx512_minus_zero(), avx512_bits(sign))));
}
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return _mm512_mask_mov_pd(a, m, _mm512_set1_pd((double)NAN)); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return _mm512_mask_mov_pd(b, m, a); }

TRIBOX_INLINE vmask m_all(void) { return (vmask)0xff; }
TRIBOX_INLINE vmask m_none(void) { return 0; }
TRIBOX_INLINE vmask m_not(vmask a) { return (vmask)~a; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return (vmask)(a | b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return (vmask)(a & b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return (vmask)(a & ~b); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return a; }

#endif
