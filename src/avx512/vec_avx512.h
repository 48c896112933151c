/* vec_avx512.h - sixteen lanes of AVX-512F; the masks live in mask registers. kernel/README.md defines the words. */
#include "target_avx512.h"
#if TRIBOX_AVX512
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <immintrin.h>
#include <stdint.h>

#include "base/bits.h"
#include "base/floats.h"
#include "kernel.h"

#define V_LANES 16
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f
#define V_EXTENT 0x1p-54f

typedef __m512 vnum;
typedef __mmask16 vmask;
typedef __m512i vint;

TRIBOX_INLINE __m512i avx512_bits(vnum a) { return _mm512_castps_si512(a); }
TRIBOX_INLINE vnum avx512_float(__m512i a) { return _mm512_castsi512_ps(a); }

TRIBOX_INLINE vnum v_load(const float *p) { return _mm512_loadu_ps(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    return _mm512_mask_loadu_ps(_mm512_set1_ps(tribox_float_at(p)), (vmask)((1u << count) - 1), p);
}
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return _mm512_maskz_loadu_ps((vmask)((1u << count) - 1), p); }
TRIBOX_INLINE vnum v_splat(float a) { return _mm512_set1_ps(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { _mm512_storeu_ps(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return _mm512_add_ps(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return _mm512_sub_ps(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return _mm512_mul_ps(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return _mm512_div_ps(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return _mm512_fmadd_ps(a, b, c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return _mm512_fmsub_ps(a, b, c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return _mm512_min_ps(a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return _mm512_max_ps(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return avx512_float(_mm512_and_si512(avx512_bits(a), _mm512_set1_epi32(0x7fffffff))); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign)
{
    const __m512i but_sign = _mm512_set1_epi32(0x7fffffff);
    return avx512_float(_mm512_ternarylogic_epi32(avx512_bits(a), avx512_bits(sign), but_sign, 0xb4)); /* a ^ (sign & ~rest) */
}
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return avx512_float(_mm512_or_si512(avx512_bits(a), avx512_bits(b))); }
#ifdef __GNUC__ /* without optimisation gcc has a macro of it, which makes a mask of -1 */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
TRIBOX_INLINE vnum v_nearest(vnum a) { return _mm512_roundscale_ps(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif
TRIBOX_INLINE vnum avx512_join(__m256 low, __m256 high)
{
    return _mm512_castpd_ps(_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_castps_pd(low)), _mm256_castps_pd(high), 1));
}
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return _mm512_cmp_ps_mask(a, _mm512_setzero_ps(), _CMP_EQ_OQ); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return _mm512_mask_blend_ps(m, b, a); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return _mm512_mask_blend_ps(m, a, _mm512_set1_ps((float)NAN)); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES])
{
    return _mm512_permutex2var_ps(a, _mm512_loadu_si512(from), b);
}
TRIBOX_INLINE vnum v_local(const void *p, const double *lo)
{
    const double *const from = p;
    return avx512_join(_mm512_cvtpd_ps(_mm512_sub_pd(_mm512_loadu_pd(from), _mm512_loadu_pd(lo))),
                       _mm512_cvtpd_ps(_mm512_sub_pd(_mm512_loadu_pd(from + 8), _mm512_loadu_pd(lo + 8))));
}
/* Row i has lanes i, i + 4, i + 8 and i + 12 in its quarters: this stays within them. */
TRIBOX_INLINE void avx512_transpose4(const vnum row[4], vnum to[4])
{
    const vnum low_01 = _mm512_unpacklo_ps(row[0], row[1]), low_23 = _mm512_unpacklo_ps(row[2], row[3]);
    const vnum high_01 = _mm512_unpackhi_ps(row[0], row[1]), high_23 = _mm512_unpackhi_ps(row[2], row[3]);
    to[0] = _mm512_shuffle_ps(low_01, low_23, 0x44);
    to[1] = _mm512_shuffle_ps(low_01, low_23, 0xee);
    to[2] = _mm512_shuffle_ps(high_01, high_23, 0x44);
    to[3] = _mm512_shuffle_ps(high_01, high_23, 0xee);
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++) {
        row[i] = _mm512_castps128_ps512(_mm_loadu_ps((const float *)from[i]));
        row[i] = _mm512_insertf32x4(row[i], _mm_loadu_ps((const float *)from[i + 4]), 1);
        row[i] = _mm512_insertf32x4(row[i], _mm_loadu_ps((const float *)from[i + 8]), 2);
        row[i] = _mm512_insertf32x4(row[i], _mm_loadu_ps((const float *)from[i + 12]), 3);
    }
    avx512_transpose4(row, to);
}
TRIBOX_INLINE __m256 avx512_local_two(const void *a, const void *b, __m512d lo)
{
    const __m512d both =
        _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd((const double *)a)), _mm256_loadu_pd((const double *)b), 1);
    return _mm512_cvtpd_ps(_mm512_sub_pd(both, lo));
}
TRIBOX_INLINE void v_local_transpose4(const void *const from[V_LANES], const double lo[4], vnum to[4])
{
    const __m512d twice = _mm512_broadcast_f64x4(_mm256_loadu_pd(lo));
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = avx512_join(avx512_local_two(from[i], from[i + 4], twice), avx512_local_two(from[i + 8], from[i + 12], twice));
    avx512_transpose4(row, to);
}

TRIBOX_INLINE vint i_load(const int32_t *p) { return _mm512_loadu_si512(p); }
TRIBOX_INLINE vint i_splat(int32_t a) { return _mm512_set1_epi32(a); }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { _mm512_storeu_si512(p, a); }
TRIBOX_INLINE vint i_cut(vnum a) { return _mm512_cvttps_epi32(a); }
TRIBOX_INLINE vint i_add(vint a, vint b) { return _mm512_add_epi32(a, b); }
TRIBOX_INLINE vint i_sub(vint a, vint b) { return _mm512_sub_epi32(a, b); }
TRIBOX_INLINE vint i_mul(vint a, vint b) { return _mm512_mullo_epi32(a, b); }
TRIBOX_INLINE vint i_and(vint a, vint b) { return _mm512_and_si512(a, b); }
TRIBOX_INLINE vint i_or(vint a, vint b) { return _mm512_or_si512(a, b); }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return _mm512_andnot_si512(b, a); }
TRIBOX_INLINE vint i_shl(vint a, vint n) { return _mm512_sllv_epi32(a, n); }
TRIBOX_INLINE vint i_shr(vint a, vint n) { return _mm512_srlv_epi32(a, n); }
TRIBOX_INLINE vint i_shl_over(vint a, vint n) { return _mm512_srlv_epi32(a, _mm512_sub_epi32(_mm512_set1_epi32(32), n)); }
TRIBOX_INLINE vint i_run(vint first, vint end)
{
    const vint ones = _mm512_set1_epi32(-1);
    return i_andnot(_mm512_sllv_epi32(ones, first), _mm512_sllv_epi32(ones, end));
}
/* In parallel within the lane: pairs of bits, nibbles, bytes, and pairs of bytes. */
TRIBOX_INLINE vint i_count(vint a)
{
    const vint in_pairs = _mm512_set1_epi32(0x33333333), in_nibbles = _mm512_set1_epi32(0x0f0f0f0f);
    a = _mm512_sub_epi32(a, _mm512_and_si512(_mm512_srli_epi32(a, 1), _mm512_set1_epi32(0x55555555)));
    a = _mm512_add_epi32(_mm512_and_si512(a, in_pairs), _mm512_and_si512(_mm512_srli_epi32(a, 2), in_pairs));
    a = _mm512_and_si512(_mm512_add_epi32(a, _mm512_srli_epi32(a, 4)), in_nibbles);
    a = _mm512_add_epi32(a, _mm512_srli_epi32(a, 8));
    return _mm512_and_si512(_mm512_add_epi32(a, _mm512_srli_epi32(a, 16)), _mm512_set1_epi32(0x3f));
}
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return _mm512_maskz_mov_epi32(m, a); }

TRIBOX_INLINE vmask m_has_bits(vint a) { return _mm512_test_epi32_mask(a, a); }
TRIBOX_INLINE vmask m_signs(vnum a) { return _mm512_cmplt_epi32_mask(avx512_bits(a), _mm512_setzero_si512()); }
TRIBOX_INLINE vmask m_all(void) { return (vmask)0xffff; }
TRIBOX_INLINE vmask m_none(void) { return 0; }
TRIBOX_INLINE vmask m_not(vmask a) { return (vmask)~a; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return (vmask)(a | b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return (vmask)(a & b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return (vmask)(a & ~b); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return a; }
TRIBOX_INLINE unsigned m_count(vmask a) { return tribox_count_bits(m_bits(a)); }

/* Not compressed to memory, which Zen 4 does in microcode. */
TRIBOX_INLINE void v_pack(float *p, vmask m, vnum a) { v_write(p, _mm512_maskz_compress_ps(m, a)); }
TRIBOX_INLINE void i_pack(int32_t *p, vmask m, vint a) { i_write(p, _mm512_maskz_compress_epi32(m, a)); }

#endif
