/* vec_wasm128_double.h - two lanes of double. */
#include "base/targets.h"
#if TRIBOX_WASM128
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <stdint.h>
#include <wasm_simd128.h>

#include "base/inexact_flag.h"
#include "kernel.h"

#define V_LANES 2
#define V_FUSED 0 /* v_fma and v_fms round twice */
#define V_UNIT 0x1p-53

typedef v128_t vnum;
typedef v128_t vmask;

TRIBOX_INLINE vnum v_load(const float *p) { return wasm_f64x2_promote_low_f32x4(wasm_v128_load64_zero(p)); }
TRIBOX_INLINE vnum v_read(const double *p) { return wasm_v128_load(p); }
TRIBOX_INLINE void v_write(double *p, vnum a) { wasm_v128_store(p, a); }
TRIBOX_INLINE void v_write_int(int32_t *p, vnum a) { wasm_v128_store64_lane(p, wasm_i32x4_trunc_sat_f64x2_zero(a), 0); }
TRIBOX_INLINE vnum v_splat(double a) { return wasm_f64x2_splat(a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return wasm_f64x2_add(a, b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return wasm_f64x2_sub(a, b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return wasm_f64x2_mul(a, b); }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return wasm_f64x2_div(a, b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return wasm_f64x2_add(wasm_f64x2_mul(a, b), c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return wasm_f64x2_sub(wasm_f64x2_mul(a, b), c); }
/* As in vec_wasm128.h. */
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return wasm_f64x2_pmin(b, a); }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return wasm_f64x2_pmax(b, a); }
TRIBOX_INLINE vnum v_abs(vnum a) { return wasm_f64x2_abs(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return wasm_v128_xor(a, wasm_v128_and(wasm_f64x2_const_splat(-0.0), sign)); }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return wasm_f64x2_gt(a, b); }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return wasm_v128_or(a, m); }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return wasm_v128_bitselect(a, b, m); }

TRIBOX_INLINE vmask m_all(void) { return wasm_i64x2_const_splat(-1); }
TRIBOX_INLINE vmask m_none(void) { return wasm_i64x2_const_splat(0); }
TRIBOX_INLINE vmask m_not(vmask a) { return wasm_v128_not(a); }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return wasm_v128_or(a, b); }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return wasm_v128_and(a, b); }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return wasm_v128_andnot(a, b); }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return wasm_i64x2_bitmask(a); }

#endif
