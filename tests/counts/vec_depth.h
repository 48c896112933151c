/*
 * vec_depth.h - a vocabulary for sums and products of numbers that are not negative: what is computed of x is at least (1 -
 * u)^depth times x. A difference is for comparisons, and no bound; nor is what is made of it.
 */
#if defined(TRIBOX_VEC_H)
#error "one vocabulary to a translation unit"
#endif
#define TRIBOX_VEC_H

#include "kernel.h"

#define V_LANES 1
#define V_UNIT 0x1p-24
#define V_ETA 0x1p-120
#define V_EXTENT 0x1p-54

typedef struct vnum {
    double x;
    int depth; /* or NO_BOUND */
} vnum;
typedef bool vmask;
enum { NO_BOUND = -1 };

TRIBOX_INLINE vnum depth_of(double x, vnum a, vnum b, int depth)
{
    return (vnum){x, a.depth == NO_BOUND || b.depth == NO_BOUND ? NO_BOUND : depth};
}
TRIBOX_INLINE int deeper(vnum a, vnum b) { return a.depth > b.depth ? a.depth : b.depth; }

TRIBOX_INLINE vnum v_splat(double a) { return (vnum){a, 0}; }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return depth_of(a.x + b.x, a, b, deeper(a, b) + 1); }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return depth_of(a.x * b.x, a, b, a.depth + b.depth + 1); }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return v_add(v_mul(a, b), c); } /* fused it rounds less */
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return depth_of(a.x > b.x ? a.x : b.x, a, b, deeper(a, b)); }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return (vnum){a.x - b.x, NO_BOUND}; }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return v_sub(v_mul(a, b), c); }
TRIBOX_INLINE vnum v_abs(vnum a) { return a; } /* none is negative */
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return (void)sign, a; }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return (vnum){a.x < b.x ? a.x : b.x, NO_BOUND}; }
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return a.x > b.x; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return a || b; }
TRIBOX_INLINE vmask m_and(vmask a, vmask b) { return a && b; }
