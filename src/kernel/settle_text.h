/* settle_text.h - the texts of the second stage, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#if defined(TRIBOX_VEC_H) /* or the compiler is for another processor */
#include "axes.h"
#include "kernel/settle/bounds.h"
#include "kernel/settle/doubles.h"
#define CODED_NUMBER double
#define CODED_NUMBERS wide
#define CODED_READ v_read
#include "codes.h"

extern const tribox_settle_kernel TRIBOX_SYMBOL(settle);
const tribox_settle_kernel TRIBOX_SYMBOL(settle) = {.in_double = in_double, .code = code_positions};

#else
typedef int tribox_no_kernel_for_this_processor;
#endif
#if TRIBOX_POP_TARGET
#pragma clang attribute pop
#endif
