/* num_integer.h - one lane of a built-in signed integer type, `vnum`, that the including file defines. Nothing rounds or overflows:
 * tribox_oriented_overlap chooses the width. */
#include <stdbool.h>
#include <stdint.h>

#include "kernel.h"

typedef bool vmask;

TRIBOX_INLINE vnum v_splat(int a) { return a; }
TRIBOX_INLINE vnum v_shifted(tribox_integer a) { return a.odd * ((vnum)1 << a.shift); }
TRIBOX_INLINE vnum v_add(vnum a, vnum b) { return a + b; }
TRIBOX_INLINE vnum v_sub(vnum a, vnum b) { return a - b; }
TRIBOX_INLINE vnum v_mul(vnum a, vnum b) { return a * b; }
TRIBOX_INLINE vnum v_fma(vnum a, vnum b, vnum c) { return a * b + c; }
TRIBOX_INLINE vnum v_fms(vnum a, vnum b, vnum c) { return a * b - c; }
TRIBOX_INLINE vnum v_min(vnum a, vnum b) { return a < b ? a : b; }
TRIBOX_INLINE vnum v_max(vnum a, vnum b) { return a > b ? a : b; }
TRIBOX_INLINE vnum v_abs(vnum a) { return a < 0 ? -a : a; }
TRIBOX_INLINE vnum v_flip(vnum a, vnum sign) { return sign < 0 ? -a : a; } /* of zero either will do: PROOFS.md 1 */
TRIBOX_INLINE vmask v_gt(vnum a, vnum b) { return a > b; }
TRIBOX_INLINE vmask m_or(vmask a, vmask b) { return a || b; }
