/* settle_text.h - the texts of the second stage, in order. After: a vocabulary of double, and KERNEL, the kernel's name. */
#include "axes.h"
#include "kernel/settle/bounds.h"
#include "kernel/settle/doubles.h"
