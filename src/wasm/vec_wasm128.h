/* vec_wasm128.h - four lanes of WebAssembly's 128-bit SIMD. kernel/README.md defines the words. */
#include "base/targets.h"
#if TRIBOX_WASM128
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <stdint.h>
#include <wasm_simd128.h>

#include "base/bits.h"
#include "base/floats.h"
#include "kernel.h"

#define V_LANES 4
#define V_FUSED 0 /* v_fma and v_fms round twice */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f
#define V_EXTENT 0x1p-54f

typedef v128_t vnum;
typedef v128_t vmask;
typedef v128_t vint;

TRIBOX_INLINE vnum v_load(const float *p) { return wasm_v128_load(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    const float first = tribox_float_at(p);
    return wasm_f32x4_make(first, tribox_float_at(p + (count > 1)), tribox_float_at(p + 2 * (count > 2)), first);
}
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return count < V_LANES ? v_load_few(p, count) : v_load(p); }
TRIBOX_INLINE vnum v_splat(float a) { return wasm_f32x4_splat(a); }
TRIBOX_INLINE void v_write(float *p, vnum a) { wasm_v128_store(p, a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return wasm_f32x4_add(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return wasm_f32x4_sub(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return wasm_f32x4_mul(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return wasm_f32x4_div(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return wasm_f32x4_add(wasm_f32x4_mul(a, b), c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return wasm_f32x4_sub(wasm_f32x4_mul(a, b), c); }
/* pmin(x, y) is y < x ? y : x, and pmax(x, y) is x < y ? y : x. min and max have other answers for NaN and zeros of two signs. */
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return wasm_f32x4_pmin(b, a); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return wasm_f32x4_pmax(b, a); }
TRIBOX_INLINE vnum v_abs(vnum a) { return wasm_f32x4_abs(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return wasm_v128_xor(a, wasm_v128_and(wasm_f32x4_const_splat(-0.0f), sign)); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return wasm_v128_or(a, b); }
TRIBOX_INLINE vnum v_nearest(vnum a) { return wasm_f32x4_nearest(a); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return wasm_f32x4_gt(a, b); }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return wasm_f32x4_eq(a, wasm_f32x4_const_splat(0)); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return wasm_v128_bitselect(a, b, m); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return wasm_v128_or(a, m); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES])
{
    float number[2 * V_LANES];
    wasm_v128_store(number, a);
    wasm_v128_store(number + V_LANES, b);
    return wasm_f32x4_make(number[from[0] % 8], number[from[1] % 8], number[from[2] % 8], number[from[3] % 8]);
}
/* Of two doubles. */
TRIBOX_INLINE vnum wasm_local(const double *p, const double *lo)
{
    return wasm_f32x4_demote_f64x2_zero(wasm_f64x2_sub(wasm_v128_load(p), wasm_v128_load(lo)));
}
TRIBOX_INLINE vnum v_local(const void *p, const double *lo)
{
    return wasm_i64x2_shuffle(wasm_local(p, lo), wasm_local((const double *)p + 2, lo + 2), 0, 2);
}
TRIBOX_INLINE void wasm_transpose4(const vnum row[4], vnum to[4])
{
    const vnum low_01 = wasm_i32x4_shuffle(row[0], row[1], 0, 4, 1, 5), low_23 = wasm_i32x4_shuffle(row[2], row[3], 0, 4, 1, 5);
    const vnum high_01 = wasm_i32x4_shuffle(row[0], row[1], 2, 6, 3, 7), high_23 = wasm_i32x4_shuffle(row[2], row[3], 2, 6, 3, 7);
    to[0] = wasm_i64x2_shuffle(low_01, low_23, 0, 2);
    to[1] = wasm_i64x2_shuffle(low_01, low_23, 1, 3);
    to[2] = wasm_i64x2_shuffle(high_01, high_23, 0, 2);
    to[3] = wasm_i64x2_shuffle(high_01, high_23, 1, 3);
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = wasm_v128_load(from[i]);
    wasm_transpose4(row, to);
}
TRIBOX_INLINE void v_local_transpose4(const void *const from[V_LANES], const double lo[4], vnum to[4])
{
    vnum row[4];
    for (int i = 0; i < 4; i++)
        row[i] = v_local(from[i], lo);
    wasm_transpose4(row, to);
}

TRIBOX_INLINE vint i_load(const int32_t *p) { return wasm_v128_load(p); }
TRIBOX_INLINE vint i_splat(int32_t a) { return wasm_i32x4_splat(a); }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { wasm_v128_store(p, a); }
TRIBOX_INLINE vint i_cut(vnum a) { return wasm_i32x4_trunc_sat_f32x4(a); }
TRIBOX_INLINE vint i_add(vint a, vint b) { return wasm_i32x4_add(a, b); }
TRIBOX_INLINE vint i_sub(vint a, vint b) { return wasm_i32x4_sub(a, b); }
TRIBOX_INLINE vint i_mul(vint a, vint b) { return wasm_i32x4_mul(a, b); }
TRIBOX_INLINE vint i_and(vint a, vint b) { return wasm_v128_and(a, b); }
TRIBOX_INLINE vint i_or(vint a, vint b) { return wasm_v128_or(a, b); }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return wasm_v128_andnot(a, b); }
/* All lanes can be shifted by one number alone, so each is multiplied by its 2^n: byte k of that is the table's byte n - 8 k, where
 * there is one. From 32 to 63, and of -1, it is 0. */
TRIBOX_INLINE vint wasm_power(vint n)
{
    const v128_t powers = wasm_u8x16_const(1, 2, 4, 8, 16, 32, 64, 128, 0, 0, 0, 0, 0, 0, 0, 0);
    const v128_t in_all_bytes = wasm_i8x16_shuffle(n, n, 0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12);
    return wasm_i8x16_swizzle(powers, wasm_i8x16_sub(in_all_bytes, wasm_i32x4_const_splat(0x18100800)));
}
TRIBOX_INLINE vint i_shl(vint a, vint n) { return wasm_i32x4_mul(a, wasm_power(n)); }
/* a * 2^(31 - n) without its last 31 bits. */
TRIBOX_INLINE vint i_shr(vint a, vint n)
{
    const vint power = wasm_power(wasm_i32x4_sub(wasm_i32x4_const_splat(31), n));
    const v128_t low = wasm_u64x2_shr(wasm_u64x2_extmul_low_u32x4(a, power), 31);
    const v128_t high = wasm_u64x2_shr(wasm_u64x2_extmul_high_u32x4(a, power), 31);
    return wasm_i32x4_shuffle(low, high, 0, 2, 4, 6);
}
TRIBOX_INLINE vint i_shl_over(vint a, vint n) { return i_shr(a, wasm_i32x4_sub(wasm_i32x4_const_splat(32), n)); }
/* 0 - 2^n has the bits from n on. */
TRIBOX_INLINE vint i_run(vint first, vint end)
{
    return wasm_v128_andnot(wasm_i32x4_neg(wasm_power(first)), wasm_i32x4_neg(wasm_power(end)));
}
TRIBOX_INLINE vint i_count(vint a)
{
    return wasm_u32x4_extadd_pairwise_u16x8(wasm_u16x8_extadd_pairwise_u8x16(wasm_i8x16_popcnt(a)));
}
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return wasm_v128_and(m, a); }

TRIBOX_INLINE vmask m_signs(vnum a) { return a; }
TRIBOX_INLINE vmask m_all(void) { return wasm_i32x4_const_splat(-1); }
TRIBOX_INLINE vmask m_none(void) { return wasm_i32x4_const_splat(0); }
TRIBOX_INLINE vmask m_not(vmask a) { return wasm_v128_not(a); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return wasm_v128_or(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return wasm_v128_and(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return wasm_v128_andnot(a, b); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return wasm_i32x4_bitmask(a); }
TRIBOX_INLINE unsigned m_count(vmask a) { return tribox_count_bits(m_bits(a)); }
TRIBOX_INLINE vmask m_has_bits(vint a) { return wasm_i32x4_ne(a, wasm_i32x4_const_splat(0)); }

/* Each lane goes where those of m before it end: one that is not of m is written over, or lies past the last. */
TRIBOX_INLINE void wasm_pack(int32_t *p, vmask m, v128_t a)
{
    const uint32_t bits = wasm_i32x4_bitmask(m), first = bits & 1, second = first + (bits >> 1 & 1),
                   third = second + (bits >> 2 & 1);
    wasm_v128_store32_lane(p, a, 0);
    wasm_v128_store32_lane(p + first, a, 1);
    wasm_v128_store32_lane(p + second, a, 2);
    wasm_v128_store32_lane(p + third, a, 3);
}
TRIBOX_INLINE void v_pack(float *p, vmask m, vnum a) { wasm_pack((int32_t *)p, m, a); }
TRIBOX_INLINE void i_pack(int32_t *p, vmask m, vint a) { wasm_pack(p, m, a); }

#endif
