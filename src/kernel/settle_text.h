/* settle_text.h - the texts of the second stage, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#include "axes.h"
#include "kernel/settle/bounds.h"
#include "kernel/settle/doubles.h"
#define CODED_NUMBER double
#define CODED_NUMBERS wide
#define CODED_READ v_read
#include "codes.h"

extern const tribox_settle_kernel TRIBOX_SYMBOL(settle);
const tribox_settle_kernel TRIBOX_SYMBOL(settle) = {.in_double = in_double, .code = code_positions};
