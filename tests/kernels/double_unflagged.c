/* double_unflagged.c - the second stage of one vocabulary as it is where the inexact flag never rises, or is out of reach. */
#define TRIBOX_NO_INEXACT_FLAG
#include VOCABULARY
#define KERNEL unflagged
#include "kernel/settle_text.h"
