/* vec_avx2_double.h - four lanes of double. */
#include "target_avx2.h"
#if TRIBOX_AVX2
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <immintrin.h>
#include <stdint.h>

#include "base/inexact_flag.h"
#include "kernel.h"

#define V_LANES 4
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-53

typedef __m256d vnum;
typedef __m256d vmask;

TRIBOX_INLINE vnum v_load(const float *p) { return _mm256_cvtps_pd(_mm_loadu_ps(p)); }
TRIBOX_INLINE vnum v_read(const double *p) { return _mm256_loadu_pd(p); }
TRIBOX_INLINE void v_write(double *p, vnum a) { _mm256_storeu_pd(p, a); }
TRIBOX_INLINE void v_write_int(int32_t *p, vnum a) { _mm_storeu_si128((__m128i *)p, _mm256_cvttpd_epi32(a)); }
TRIBOX_INLINE vnum v_splat(double a) { return _mm256_set1_pd(a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return _mm256_add_pd(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return _mm256_sub_pd(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return _mm256_mul_pd(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return _mm256_div_pd(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return _mm256_fmadd_pd(a, b, c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return _mm256_fmsub_pd(a, b, c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return _mm256_min_pd(a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return _mm256_max_pd(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return _mm256_xor_pd(a, _mm256_and_pd(_mm256_set1_pd(-0.0), sign)); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return _mm256_cmp_pd(a, b, _CMP_GT_OQ); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return _mm256_or_pd(a, m); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return _mm256_blendv_pd(b, a, m); }

TRIBOX_INLINE vmask m_all(void) { return _mm256_castsi256_pd(_mm256_set1_epi32(-1)); }
TRIBOX_INLINE vmask m_none(void) { return _mm256_setzero_pd(); }
TRIBOX_INLINE vmask m_not(vmask a) { return _mm256_andnot_pd(a, m_all()); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return _mm256_or_pd(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return _mm256_and_pd(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return _mm256_andnot_pd(b, a); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return (uint64_t)(unsigned)_mm256_movemask_pd(a); }

#endif
