/* vec_avx2.h - eight lanes of AVX2 with FMA. kernel/README.md defines the words. */
#include "target_avx2.h"
#if TRIBOX_AVX2
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <immintrin.h>
#include <stdint.h>

#include "base/bits.h"
#include "base/floats.h"
#include "kernel.h"

#define V_LANES 8
#define V_FUSED 1 /* v_fma and v_fms round once */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f
#define V_EXTENT 0x1p-54f

typedef __m256 vnum;
typedef __m256 vmask;
typedef __m256i vint;

TRIBOX_INLINE vnum v_load(const float *p) { return _mm256_loadu_ps(p); }
TRIBOX_INLINE __m256i avx2_first(size_t count)
{
    static const int32_t is_first[2 * V_LANES] = {-1, -1, -1, -1, -1, -1, -1, -1};
    return _mm256_loadu_si256((const __m256i *)(is_first + V_LANES - count));
}
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return _mm256_maskload_ps(p, avx2_first(count)); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    return _mm256_blendv_ps(_mm256_set1_ps(tribox_float_at(p)), v_load_up_to(p, count), _mm256_castsi256_ps(avx2_first(count)));
}
TRIBOX_INLINE vnum v_splat(float a) { return _mm256_set1_ps(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { _mm256_storeu_ps(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return _mm256_add_ps(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return _mm256_sub_ps(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return _mm256_mul_ps(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return _mm256_div_ps(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return _mm256_fmadd_ps(a, b, c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return _mm256_fmsub_ps(a, b, c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return _mm256_min_ps(a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return _mm256_max_ps(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return _mm256_xor_ps(a, _mm256_and_ps(_mm256_set1_ps(-0.0f), sign)); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return _mm256_or_ps(a, b); }
TRIBOX_INLINE vnum v_nearest(vnum a) { return _mm256_round_ps(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); }
TRIBOX_INLINE vnum avx2_join(__m128 low, __m128 high) { return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return _mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_EQ_OQ); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return _mm256_blendv_ps(b, a, m); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return _mm256_or_ps(a, m); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES])
{
    const __m256i lane = _mm256_loadu_si256((const __m256i *)from);
    return _mm256_blendv_ps(_mm256_permutevar8x32_ps(a, lane), _mm256_permutevar8x32_ps(b, lane),
                            _mm256_castsi256_ps(_mm256_slli_epi32(lane, 28)));
}
/* Row i has lanes i and i + 4 in its halves: what follows stays within them. */
TRIBOX_INLINE __m128 avx2_local(const void *p, __m256d lo)
{
    return _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_loadu_pd((const double *)p), lo));
}
TRIBOX_INLINE vnum v_local(const void *p, const double *lo)
{
    return avx2_join(avx2_local(p, _mm256_loadu_pd(lo)), avx2_local((const double *)p + 4, _mm256_loadu_pd(lo + 4)));
}
TRIBOX_INLINE void avx2_transpose4(const vnum row[4], vnum to[4])
{
    const vnum low_01 = _mm256_unpacklo_ps(row[0], row[1]), low_23 = _mm256_unpacklo_ps(row[2], row[3]);
    const vnum high_01 = _mm256_unpackhi_ps(row[0], row[1]), high_23 = _mm256_unpackhi_ps(row[2], row[3]);
    to[0] = _mm256_shuffle_ps(low_01, low_23, 0x44);
    to[1] = _mm256_shuffle_ps(low_01, low_23, 0xee);
    to[2] = _mm256_shuffle_ps(high_01, high_23, 0x44);
    to[3] = _mm256_shuffle_ps(high_01, high_23, 0xee);
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = avx2_join(_mm_loadu_ps((const float *)from[i]), _mm_loadu_ps((const float *)from[i + 4]));
    avx2_transpose4(row, to);
}
TRIBOX_INLINE void v_local_transpose4(const void *const from[V_LANES], const double lo[4], vnum to[4])
{
    const __m256d corner = _mm256_loadu_pd(lo);
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = avx2_join(avx2_local(from[i], corner), avx2_local(from[i + 4], corner));
    avx2_transpose4(row, to);
}

TRIBOX_INLINE vint i_load(const int32_t *p) { return _mm256_loadu_si256((const __m256i *)p); }
TRIBOX_INLINE vint i_splat(int32_t a) { return _mm256_set1_epi32(a); }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { _mm256_storeu_si256((__m256i *)p, a); }
TRIBOX_INLINE vint i_cut(vnum a) { return _mm256_cvttps_epi32(a); }
TRIBOX_INLINE vint i_add(vint a, vint b) { return _mm256_add_epi32(a, b); }
TRIBOX_INLINE vint i_sub(vint a, vint b) { return _mm256_sub_epi32(a, b); }
TRIBOX_INLINE vint i_mul(vint a, vint b) { return _mm256_mullo_epi32(a, b); }
TRIBOX_INLINE vint i_and(vint a, vint b) { return _mm256_and_si256(a, b); }
TRIBOX_INLINE vint i_or(vint a, vint b) { return _mm256_or_si256(a, b); }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return _mm256_andnot_si256(b, a); }
TRIBOX_INLINE vint i_shl(vint a, vint n) { return _mm256_sllv_epi32(a, n); }
TRIBOX_INLINE vint i_shr(vint a, vint n) { return _mm256_srlv_epi32(a, n); }
TRIBOX_INLINE vint i_shl_over(vint a, vint n) { return _mm256_srlv_epi32(a, _mm256_sub_epi32(_mm256_set1_epi32(32), n)); }
TRIBOX_INLINE vint i_run(vint first, vint end)
{
    const vint ones = _mm256_set1_epi32(-1);
    return i_andnot(_mm256_sllv_epi32(ones, first), _mm256_sllv_epi32(ones, end));
}
/* Of nibbles by a table, and sums of four bytes. */
TRIBOX_INLINE vint i_count(vint a)
{
    const __m256i nibble = _mm256_set1_epi8(15);
    const __m256i count = _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4));
    const __m256i low = _mm256_shuffle_epi8(count, _mm256_and_si256(a, nibble));
    const __m256i high = _mm256_shuffle_epi8(count, _mm256_and_si256(_mm256_srli_epi32(a, 4), nibble));
    return _mm256_madd_epi16(_mm256_maddubs_epi16(_mm256_add_epi8(low, high), _mm256_set1_epi8(1)), _mm256_set1_epi16(1));
}
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return _mm256_and_si256(_mm256_castps_si256(m), a); }

TRIBOX_INLINE vmask m_signs(vnum a) { return a; }
TRIBOX_INLINE vmask m_all(void) { return _mm256_castsi256_ps(_mm256_set1_epi32(-1)); }
TRIBOX_INLINE vmask m_none(void) { return _mm256_setzero_ps(); }
TRIBOX_INLINE vmask m_not(vmask a) { return _mm256_andnot_ps(a, m_all()); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return _mm256_or_ps(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return _mm256_and_ps(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return _mm256_andnot_ps(b, a); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return (uint64_t)(unsigned)_mm256_movemask_ps(a); }
TRIBOX_INLINE unsigned m_count(vmask a) { return tribox_count_bits(m_bits(a)); }
TRIBOX_INLINE vmask m_has_bits(vint a) { return m_not(_mm256_castsi256_ps(_mm256_cmpeq_epi32(a, _mm256_setzero_si256()))); }

/* For each set of the lanes up to k, its lanes as bytes, the first lowest; before the bytes of the lanes above. */
#define AVX2_SETS_TO_0(above) (above), ((above) << 8 | 0)
#define AVX2_SETS_TO_1(above) AVX2_SETS_TO_0(above), AVX2_SETS_TO_0((above) << 8 | 1)
#define AVX2_SETS_TO_2(above) AVX2_SETS_TO_1(above), AVX2_SETS_TO_1((above) << 8 | 2)
#define AVX2_SETS_TO_3(above) AVX2_SETS_TO_2(above), AVX2_SETS_TO_2((above) << 8 | 3)
#define AVX2_SETS_TO_4(above) AVX2_SETS_TO_3(above), AVX2_SETS_TO_3((above) << 8 | 4)
#define AVX2_SETS_TO_5(above) AVX2_SETS_TO_4(above), AVX2_SETS_TO_4((above) << 8 | 5)
#define AVX2_SETS_TO_6(above) AVX2_SETS_TO_5(above), AVX2_SETS_TO_5((above) << 8 | 6)
#define AVX2_SETS_TO_7(above) AVX2_SETS_TO_6(above), AVX2_SETS_TO_6((above) << 8 | 7)
/* The numbers of the lanes of m, closed up. */
TRIBOX_INLINE __m256i avx2_lanes(vmask m)
{
    static const uint64_t set[256] = {AVX2_SETS_TO_7(UINT64_C(0))};
    return _mm256_cvtepu8_epi32(_mm_set_epi64x(0, (int64_t)set[m_bits(m)]));
}
TRIBOX_INLINE void v_pack(float *p, vmask m, vnum a) { v_write(p, _mm256_permutevar8x32_ps(a, avx2_lanes(m))); }
TRIBOX_INLINE void i_pack(int32_t *p, vmask m, vint a) { i_write(p, _mm256_permutevar8x32_epi32(a, avx2_lanes(m))); }

#endif
