/* vec_scalar.h - one lane. This is the definition of every word; kernel/README.md has the rest. */
#include "base/targets.h"
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-vectorize")
#endif
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/bits.h"
#include "base/floats.h"
#include "kernel.h"

#define V_LANES 1
#define V_FUSED 0 /* v_fma and v_fms round twice */
#define V_UNIT 0x1p-24f
#define V_ETA 0x1p-120f
#define V_EXTENT 0x1p-54f

typedef float vnum;
typedef bool vmask;
typedef int32_t vint;

TRIBOX_INLINE uint32_t scalar_bits(float a)
{
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

TRIBOX_INLINE float scalar_float(uint32_t bits)
{
    float a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

/* All bits or none. Of a choice by `?` compilers make a branch, which one lane cannot foresee. */
TRIBOX_INLINE uint32_t scalar_ones(bool m) { return 0 - (uint32_t)m; }

TRIBOX_INLINE vnum v_load(const float *p) { return tribox_float_at(p); }
TRIBOX_INLINE vnum v_load_few(const float *p, size_t count)
{
    (void)count;
    return v_load(p);
}
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return v_load_few(p, count); }
TRIBOX_INLINE vnum v_splat(float a) { return a; }
TRIBOX_INLINE void v_write(void *p, vnum a) { memcpy(p, &a, sizeof a); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return a + b; }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return a - b; }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return a * b; }
TRIBOX_INLINE vnum v_div(vnum a, vnum b) { return a / b; }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return a * b + c; }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return a * b - c; }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return a < b ? a : b; }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return a > b ? a : b; }
TRIBOX_INLINE vnum v_abs(vnum a) { return fabsf(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return a * copysignf(1, sign); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return scalar_float(scalar_bits(a) | scalar_bits(b)); }
/* So far from zero floats are whole: the sum rounds to a whole number. */
TRIBOX_INLINE vnum v_nearest(vnum a) { return a + 0x1.8p23f - 0x1.8p23f; }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return a > b; }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return a == 0; }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b)
{
    return scalar_float((scalar_bits(a) & scalar_ones(m)) | (scalar_bits(b) & ~scalar_ones(m)));
}
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return scalar_float(scalar_bits(a) | scalar_ones(m)); }
TRIBOX_INLINE vnum v_permute(vnum a, vnum b, const int32_t from[V_LANES]) { return from[0] % 2 ? b : a; }
/* One by one, so that those that are not needed are not read. */
TRIBOX_INLINE vnum v_local(const void *p, const double *lo)
{
    double number;
    memcpy(&number, p, sizeof number);
    return (float)(number - *lo);
}
TRIBOX_INLINE void v_transpose4(const void *const from[V_LANES], vnum to[4])
{
    for (int k = 0; k < 4; k++)
        to[k] = tribox_float_at((const float *)from[0] + k);
}
TRIBOX_INLINE void v_local_transpose4(const void *const from[V_LANES], const double lo[4], vnum to[4])
{
    for (int k = 0; k < 4; k++)
        to[k] = v_local((const double *)from[0] + k, lo + k);
}

TRIBOX_INLINE vint i_load(const int32_t *p) { return *p; }
TRIBOX_INLINE vint i_splat(int32_t a) { return a; }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { *p = a; }
TRIBOX_INLINE vint i_cut(vnum a) { return (int32_t)a; }
TRIBOX_INLINE vint i_add(vint a, vint b) { return (int32_t)((uint32_t)a + (uint32_t)b); }
TRIBOX_INLINE vint i_sub(vint a, vint b) { return (int32_t)((uint32_t)a - (uint32_t)b); }
TRIBOX_INLINE vint i_mul(vint a, vint b) { return (int32_t)((uint32_t)a * (uint32_t)b); }
TRIBOX_INLINE vint i_and(vint a, vint b) { return a & b; }
TRIBOX_INLINE vint i_or(vint a, vint b) { return a | b; }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return a & ~b; }
TRIBOX_INLINE vint i_shl(vint a, vint n) { return (int32_t)(uint32_t)((uint64_t)(uint32_t)a << n); }
TRIBOX_INLINE vint i_shr(vint a, vint n) { return (int32_t)(uint32_t)((uint64_t)(uint32_t)a >> n); }
TRIBOX_INLINE vint i_shl_over(vint a, vint n) { return (int32_t)(uint32_t)((uint64_t)(uint32_t)a << n >> 32); }
TRIBOX_INLINE vint i_run(vint first, vint end)
{
    return first < end ? (int32_t)(uint32_t)((UINT64_C(1) << end) - (UINT64_C(1) << first)) : 0;
}
TRIBOX_INLINE vint i_count(vint a) { return (int32_t)tribox_count_bits((uint32_t)a); }
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return a & (int32_t)scalar_ones(m); }

TRIBOX_INLINE vmask m_has_bits(vint a) { return a != 0; }
TRIBOX_INLINE vmask m_signs(vnum a) { return scalar_bits(a) >> 31; }
TRIBOX_INLINE vmask m_all(void) { return true; }
TRIBOX_INLINE vmask m_none(void) { return false; }
TRIBOX_INLINE vmask m_not(vmask a) { return !a; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return a + b > 0; } /* of a | b gcc makes two branches, often mispredicted */
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return a & b; }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return a & !b; }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return a; }
TRIBOX_INLINE unsigned m_count(vmask a) { return a; }

TRIBOX_INLINE void v_pack(float *p, vmask m, vnum a)
{
    (void)m;
    *p = a;
}
TRIBOX_INLINE void i_pack(int32_t *p, vmask m, vint a)
{
    (void)m;
    *p = a;
}
