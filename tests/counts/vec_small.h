/*
 * vec_small.h - one lane of tiny floats: SMALL_BITS bits of significand, rounded to nearest, ties to even, no greatest number.
 *
 * A vnum is a double that holds one. A sum or product of two is exact in double before it is rounded, as long as numbers have 12
 * bits at most and those of the input lie within 2^18 of each other. What the constants of the texts stand on can be chosen, right
 * or wrong:
 *
 *   SMALL_BITS     p, so u = 2^-p: 6
 *   SMALL_K        what bounds.h writes as 16, which it is; 17, 24 and 34 change in proportion
 *   SMALL_LEAST    the least number is 2^SMALL_LEAST, and all are multiples of it; without it nothing underflows
 *   SMALL_ETA      V_ETA in least numbers: 32 times the 6 that tau_of needs of each unit of h (PROOFS.md 3.7), and then some
 *   SMALL_EXTENT   what V_EXTENT is twice of, in least numbers: its square is a least number over u at least (PROOFS.md 5.1)
 *   SMALL_TOUCHES  v_gt is true of equal numbers too, which is wrong
 */
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "kernel.h"

#define V_LANES 1
#if !defined(V_FUSED)
#define V_FUSED 0
#endif
#if !defined(SMALL_BITS)
#define SMALL_BITS 6
#endif
#if !defined(SMALL_K)
#define SMALL_K 16
#endif
#if defined(SMALL_LEAST)
#define SMALL_HAS_LEAST 1
#else
#define SMALL_HAS_LEAST 0
#define SMALL_LEAST -15 /* any unit will do, but one far below 1 shows a text that compares with a length */
#endif
#if !defined(SMALL_ETA)
#define SMALL_ETA 256
#endif
#if !defined(SMALL_EXTENT)
#define SMALL_EXTENT (1 << (SMALL_BITS - SMALL_LEAST + 1) / 2)
#endif
#if !defined(SMALL_TOUCHES)
#define SMALL_TOUCHES 0
#endif

/* One unit of the input: the least number where there is one. */
#define SMALL_ONE (1.0 / (1 << -SMALL_LEAST))
#define SMALL_UNIT (1.0 / (1 << SMALL_BITS))
#define V_UNIT (SMALL_UNIT * SMALL_K / 16)
#define V_ETA (SMALL_HAS_LEAST * SMALL_ETA * SMALL_ONE)
#define V_EXTENT (2 * SMALL_HAS_LEAST * SMALL_EXTENT * SMALL_ONE)

typedef double vnum;
typedef bool vmask;
typedef int32_t vint; /* children of split.h, no more */

TRIBOX_INLINE double small_rounded(double a)
{
    /* Below this all floats are whole numbers of the least one; a zero keeps its sign. */
    if (SMALL_HAS_LEAST && fabs(a) < SMALL_ONE * (1 << SMALL_BITS)) {
        const double far_away = 0x1.8p52 * SMALL_ONE;
        return copysign(a + far_away - far_away, a);
    }
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    bits += (UINT64_C(1) << (52 - SMALL_BITS)) - 1 + (bits >> (53 - SMALL_BITS) & 1);
    bits &= ~((UINT64_C(1) << (53 - SMALL_BITS)) - 1);
    memcpy(&a, &bits, sizeof a);
    return a;
}

TRIBOX_INLINE vnum v_load(const float *p) { return (double)*p; }
TRIBOX_INLINE vnum v_load_up_to(const float *p, size_t count) { return (void)count, v_load(p); }
TRIBOX_INLINE vnum v_splat(double a) { return a; }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return small_rounded(a + b); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return small_rounded(a - b); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return small_rounded(a * b); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return small_rounded((V_FUSED ? a * b : small_rounded(a * b)) + c); }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return small_rounded((V_FUSED ? a * b : small_rounded(a * b)) - c); }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return a < b ? a : b; }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return a > b ? a : b; }
TRIBOX_INLINE vnum v_abs(vnum a) { return fabs(a); }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return a * copysign(1, sign); }
TRIBOX_INLINE vnum v_either(vnum a, vnum b) { return signbit(a) ? a : b; }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return SMALL_TOUCHES ? a >= b : a > b; }
TRIBOX_INLINE vmask v_is_zero(vnum a) { return a == 0; }
TRIBOX_INLINE vnum v_select(vmask m, vnum a, vnum b) { return m ? a : b; }
TRIBOX_INLINE vnum v_drop(vmask m, vnum a) { return m ? (double)NAN : a; }

TRIBOX_INLINE vmask m_signs(vnum a) { return signbit(a); }
TRIBOX_INLINE vmask m_all(void) { return true; }
TRIBOX_INLINE vmask m_none(void) { return false; }
TRIBOX_INLINE vmask m_not(vmask a) { return !a; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return a || b; }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return a && b; }
TRIBOX_INLINE vmask m_andnot(vmask a, vmask b) { return a && !b; }
TRIBOX_INLINE uint64_t m_bits(vmask a) { return a; }

TRIBOX_INLINE vint i_splat(int32_t a) { return a; }
TRIBOX_INLINE void i_write(int32_t *p, vint a) { *p = a; }
TRIBOX_INLINE vint i_and(vint a, vint b) { return a & b; }
TRIBOX_INLINE vint i_or(vint a, vint b) { return a | b; }
TRIBOX_INLINE vint i_andnot(vint a, vint b) { return a & ~b; }
TRIBOX_INLINE vint i_shl(vint a, vint n) { return a << n; }
TRIBOX_INLINE vint i_keep(vmask m, vint a) { return m ? a : 0; }
TRIBOX_INLINE vmask m_has_bits(vint a) { return a != 0; }
