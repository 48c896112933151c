/* vec_sse2.h - four lanes of SSE2, the baseline of x86-64. kernel/README.md defines the words. */
#include "base/targets.h"
#if TRIBOX_SSE2
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <emmintrin.h>
#include <stdint.h>
#include <string.h>

#include "base/floats.h"
#include "kernel.h"

#define V_LANES 4
#define V_FUSED 0 /* v_fma and v_fms round twice */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f
#define V_EXTENT 0x1p-54f

typedef __m128 vnum;
typedef __m128 vmask;
typedef __m128i vint;

TRIBOX_INLINE vnum v_load(const float *p) { return _mm_loadu_ps(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    const float first = tribox_float_at(p);
    return _mm_setr_ps(first, tribox_float_at(p + (count > 1)), tribox_float_at(p + 2 * (count > 2)), first);
}
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return count < V_LANES ? v_load_few(p, count) : v_load(p); }
TRIBOX_INLINE vnum v_splat(float a) { return _mm_set1_ps(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { _mm_storeu_ps(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return _mm_add_ps(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return _mm_sub_ps(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return _mm_mul_ps(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return _mm_div_ps(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return _mm_add_ps(_mm_mul_ps(a, b), c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return _mm_sub_ps(_mm_mul_ps(a, b), c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return _mm_min_ps(a, b); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return _mm_max_ps(a, b); }
TRIBOX_INLINE vnum v_abs(vnum a) { return _mm_and_ps(_mm_castsi128_ps(_mm_set1_epi32(0x7fffffff)), a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return _mm_xor_ps(a, _mm_and_ps(_mm_set1_ps(-0.0f), sign)); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return _mm_or_ps(a, b); }
/* So far from zero floats are whole: the sum rounds to a whole number. */
TRIBOX_INLINE vnum v_nearest(vnum a) { return _mm_sub_ps(_mm_add_ps(a, _mm_set1_ps(0x1.8p23f)), _mm_set1_ps(0x1.8p23f)); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return _mm_cmpgt_ps(a, b); }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return _mm_cmpeq_ps(a, _mm_setzero_ps()); }
/* Two copies of the mask fewer than by and, andnot and or, as its operations write over their first operand. */
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return _mm_xor_ps(_mm_and_ps(_mm_xor_ps(a, b), m), b); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return _mm_or_ps(a, m); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES])
{
    float number[2 * V_LANES];
    _mm_storeu_ps(number, a);
    _mm_storeu_ps(number + V_LANES, b);
    return _mm_setr_ps(number[from[0] % 8], number[from[1] % 8], number[from[2] % 8], number[from[3] % 8]);
}
/* Of two doubles. */
TRIBOX_INLINE vnum sse2_local(const double *p, const double *lo)
{
    return _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(p), _mm_loadu_pd(lo)));
}
TRIBOX_INLINE vnum v_local(const void *p, const double *lo)
{
    return _mm_movelh_ps(sse2_local(p, lo), sse2_local((const double *)p + 2, lo + 2));
}
TRIBOX_INLINE void sse2_transpose4(const vnum row[4], vnum to[4])
{
    const vnum low_01 = _mm_unpacklo_ps(row[0], row[1]), low_23 = _mm_unpacklo_ps(row[2], row[3]);
    const vnum high_01 = _mm_unpackhi_ps(row[0], row[1]), high_23 = _mm_unpackhi_ps(row[2], row[3]);
    to[0] = _mm_movelh_ps(low_01, low_23);
    to[1] = _mm_movehl_ps(low_23, low_01);
    to[2] = _mm_movelh_ps(high_01, high_23);
    to[3] = _mm_movehl_ps(high_23, high_01);
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = _mm_loadu_ps((const float *)from[i]);
    sse2_transpose4(row, to);
}
TRIBOX_INLINE void v_local_transpose4(const void *const from[V_LANES], const double lo[4], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = v_local(from[i], lo);
    sse2_transpose4(row, to);
}

TRIBOX_INLINE vint i_load(const int32_t *p) { return _mm_loadu_si128((const __m128i *)p); }
TRIBOX_INLINE vint i_splat(int32_t a) { return _mm_set1_epi32(a); }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { _mm_storeu_si128((__m128i *)p, a); }
TRIBOX_INLINE vint i_cut(vnum a) { return _mm_cvttps_epi32(a); }
TRIBOX_INLINE vint i_add(vint a, vint b) { return _mm_add_epi32(a, b); }
TRIBOX_INLINE vint i_sub(vint a, vint b) { return _mm_sub_epi32(a, b); }
/* Products of 64 bits: SSE2 multiplies the even lanes alone, and shifts all lanes by one number. */
typedef struct sse2_products {
    __m128i even, odd;
} sse2_products;
TRIBOX_INLINE sse2_products sse2_multiply(vint a, vint b)
{
    return (sse2_products){_mm_mul_epu32(a, b), _mm_mul_epu32(_mm_srli_epi64(a, 32), _mm_srli_epi64(b, 32))};
}
TRIBOX_INLINE vint sse2_low(sse2_products p)
{
    const vnum low = _mm_shuffle_ps(_mm_castsi128_ps(p.even), _mm_castsi128_ps(p.odd), 0x88);
    return _mm_shuffle_epi32(_mm_castps_si128(low), 0xd8);
}
TRIBOX_INLINE vint sse2_high(sse2_products p)
{
    const vnum high = _mm_shuffle_ps(_mm_castsi128_ps(p.even), _mm_castsi128_ps(p.odd), 0xdd);
    return _mm_shuffle_epi32(_mm_castps_si128(high), 0xd8);
}
TRIBOX_INLINE vint i_mul(vint a, vint b) { return sse2_low(sse2_multiply(a, b)); }
TRIBOX_INLINE vint i_and(vint a, vint b) { return _mm_and_si128(a, b); }
TRIBOX_INLINE vint i_or(vint a, vint b) { return _mm_or_si128(a, b); }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return _mm_andnot_si128(b, a); }
/* 2^n by the exponent of a float, its fraction cut off. 2^31 does not fit, but what comes instead are its bits. */
TRIBOX_INLINE vint sse2_power(vint n)
{
    return _mm_cvttps_epi32(_mm_castsi128_ps(_mm_slli_epi32(_mm_add_epi32(n, _mm_set1_epi32(127)), 23)));
}
/* The product by 2^n, which has both what stays and what moves out; by 0 of 32. */
TRIBOX_INLINE sse2_products sse2_shift(vint a, vint n)
{
    return sse2_multiply(a, _mm_and_si128(sse2_power(n), _mm_cmplt_epi32(n, _mm_set1_epi32(32))));
}
TRIBOX_INLINE vint i_shl(vint a, vint n) { return sse2_low(sse2_shift(a, n)); }
TRIBOX_INLINE vint i_shl_over(vint a, vint n) { return sse2_high(sse2_shift(a, n)); }
/* a * 2^(31 - n) without its last 31 bits. */
TRIBOX_INLINE vint i_shr(vint a, vint n)
{
    const sse2_products p = sse2_multiply(a, sse2_power(_mm_sub_epi32(_mm_set1_epi32(31), n)));
    return _mm_or_si128(_mm_srli_epi64(p.even, 31), _mm_slli_epi64(_mm_srli_epi64(p.odd, 31), 32));
}
/* 2^end - 2^first, the former as twice the power before it, which fits. */
TRIBOX_INLINE vint i_run(vint first, vint end)
{
    const vint half = sse2_power(_mm_sub_epi32(end, _mm_set1_epi32(1)));
    return _mm_and_si128(_mm_sub_epi32(_mm_add_epi32(half, half), sse2_power(first)), _mm_cmpgt_epi32(end, first));
}
/* In parallel within the lane: pairs of bits, nibbles, and bytes; and their sums by products. */
TRIBOX_INLINE vint i_count(vint a)
{
    const vint in_pairs = _mm_set1_epi32(0x33333333), in_nibbles = _mm_set1_epi32(0x0f0f0f0f);
    a = _mm_sub_epi32(a, _mm_and_si128(_mm_srli_epi32(a, 1), _mm_set1_epi32(0x55555555)));
    a = _mm_add_epi32(_mm_and_si128(a, in_pairs), _mm_and_si128(_mm_srli_epi32(a, 2), in_pairs));
    a = _mm_and_si128(_mm_add_epi32(a, _mm_srli_epi32(a, 4)), in_nibbles);
    return _mm_madd_epi16(_mm_srli_epi16(_mm_mullo_epi16(a, _mm_set1_epi16(0x0101)), 8), _mm_set1_epi16(1));
}
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return _mm_and_si128(_mm_castps_si128(m), a); }

TRIBOX_INLINE vmask m_signs(vnum a) { return a; }
TRIBOX_INLINE vmask m_all(void) { return _mm_castsi128_ps(_mm_set1_epi32(-1)); }
TRIBOX_INLINE vmask m_none(void) { return _mm_setzero_ps(); }
TRIBOX_INLINE vmask m_not(vmask a) { return _mm_andnot_ps(a, m_all()); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return _mm_or_ps(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return _mm_and_ps(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return _mm_andnot_ps(b, a); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return (uint64_t)(unsigned)_mm_movemask_ps(a); }
/* A table of nibbles. */
TRIBOX_INLINE unsigned m_count(vmask a)
{
    static const uint8_t count[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    return count[m_bits(a)];
}
TRIBOX_INLINE vmask m_has_bits(vint a) { return m_not(_mm_castsi128_ps(_mm_cmpeq_epi32(a, _mm_setzero_si128()))); }

/*
 * Pairs of lanes: the second is moved down where the first is not of m, and the high pair goes to the place where those of m in the
 * low one end. So for each set, whose fourth lane changes neither: by how many bits each pair is moved, and that place.
 */
TRIBOX_INLINE void sse2_pack(void *p, vmask m, __m128i a)
{
    static const struct {
        int32_t low, high, place;
    } by[16] = {{32, 32, 0}, {0, 32, 1}, {32, 32, 1}, {0, 32, 2}, {32, 0, 0}, {0, 0, 1}, {32, 0, 1}, {0, 0, 2},
                {32, 32, 0}, {0, 32, 1}, {32, 32, 1}, {0, 32, 2}, {32, 0, 0}, {0, 0, 1}, {32, 0, 1}, {0, 0, 2}};
    const uint64_t set = m_bits(m);
    const __m128i high = _mm_srl_epi64(a, _mm_cvtsi32_si128(by[set].high));
    _mm_storel_epi64((__m128i *)p, _mm_srl_epi64(a, _mm_cvtsi32_si128(by[set].low)));
    _mm_storeh_pi((__m64 *)((float *)p + by[set].place), _mm_castsi128_ps(high));
}
TRIBOX_INLINE void v_pack(float *p, vmask m, vnum a) { sse2_pack(p, m, _mm_castps_si128(a)); }
TRIBOX_INLINE void i_pack(int32_t *p, vmask m, vint a) { sse2_pack(p, m, a); }

#endif
