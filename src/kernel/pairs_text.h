/* pairs_text.h - the texts of a kernel in float, in order. After: a vocabulary of float, and KERNEL, the kernel's name. */
#if defined(TRIBOX_VEC_H) /* or the compiler is for another processor */
#include "base/bits.h"
#include "base/floats.h"
#include "kernel/pairs/tail.h"
#include "axes.h"
#include "rounding.h"
#include "kernel/pairs/nine.h"
#include "kernel/pairs/corners.h"
#include "kernel/pairs/margin.h"
#include "kernel/pairs/ties.h"
#include "kernel/pairs/local.h"
#include "kernel/pairs/packet.h"
#include "kernel/pairs/inside.h"
#include "kernel/pairs/pack.h"
#include "kernel/pairs/gather.h"
#include "kernel/pairs/apart_words.h"
#define CODED_NUMBER float
#define CODED_NUMBERS single
#define CODED_READ v_load
#include "codes.h"
#include "frame.h"
#include "kernel/pairs/move.h"
#include "kernel/pairs/survey.h"
#include "kernel/pairs/split.h"
#include "kernel/pairs/batch.h"

#else
typedef int tribox_no_kernel_for_this_processor;
#endif
#if TRIBOX_POP_TARGET
#pragma clang attribute pop
#endif
